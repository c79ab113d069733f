// SPDX-License-Identifier: Apache-2.0
/// Solid fraction, pore pressure and film of a mixture, at one instant and at the end.
#pragma once

#include "engine/core/sum.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/moving_set.hpp"
#include "engine/simulation/member_result.hpp"

#include <algorithm>
#include <span>

namespace sturz {

/// Means over the mass present, zeros where there is none.
struct MixtureState {
  double solid_fraction = 0;  ///< [1]
  double pressure_ratio = 0;  ///< basal pore pressure over total normal stress [1]
  double film_m3 = 0;         ///< water that the mass has given off and carries
  double solids_m3 = 0;       ///< grains
  double water_m3 = 0;        ///< in the pores, from solid fraction and saturation, and in the film
};

/// Adds one set to the sums of mass times fraction and ratio, and to the volumes.
inline void add_mixture_of(const MovingSet& p, MixtureState& sums, double& mass, Sum& solids_sum,
                           Sum& water_sum) {
  if (!p.has(fields::solid_fraction)) return;
  const auto &solids = p.scalar(fields::solids_volume), &water = p.scalar(fields::water_volume),
             &fraction = p.scalar(fields::solid_fraction),
             &pressure = p.scalar(fields::pore_pressure), &thickness = p.scalar(fields::thickness),
             &g_n = p.scalar(fields::normal_gravity);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double m = fraction[i], pores = solids[i] * (1 - m) / m;
    const double saturation = std::min(1.0, water[i] / pores);
    const double film = std::max(0.0, water[i] - pores);
    const double stress = p.mass[i] / (solids[i] + water[i]) * g_n[i] * thickness[i];
    mass += p.mass[i];
    sums.solid_fraction += p.mass[i] * m;
    if (stress > 0) sums.pressure_ratio += p.mass[i] * pressure[i] / stress;
    sums.film_m3 += film;
    solids_sum.add(solids[i]);
    water_sum.add(saturation * pores), water_sum.add(film);
  }
}

inline MixtureState mixture_state(std::span<const MovingSet> sets) {
  MixtureState sums;
  double mass = 0;
  Sum solids, water;
  for (const MovingSet& set : sets) add_mixture_of(set, sums, mass, solids, water);
  sums.solids_m3 = solids.value(), sums.water_m3 = water.value();
  if (mass > 0) sums.solid_fraction /= mass, sums.pressure_ratio /= mass;
  return sums;
}

/// What a member keeps of it; NaN where the scene has no mixture.
inline void write_mixture(const MixtureState& end, double most_pressure_ratio, const Ledger& ledger,
                          MemberScalars& m) {
  const bool wet = ledger.released_solids > 0;
  const auto kept = [wet](double v) { return wet ? v : nan_d; };
  m.max_pore_pressure_ratio = kept(most_pressure_ratio);
  m.end_pore_pressure_ratio = kept(end.pressure_ratio);
  m.end_solid_fraction = kept(end.solid_fraction);
  m.end_film_m3 = kept(end.film_m3);
  m.solids_error = kept((end.solids_m3 + ledger.lost_solids) / ledger.released_solids - 1);
  m.water_error = kept((end.water_m3 + ledger.lost_water) / ledger.released_water - 1);
  const double energy = ledger.available_energy();
  m.pore_clipped_fraction = kept(energy > 0 ? ledger.clipped_work / energy : 0);
}

}  // namespace sturz
