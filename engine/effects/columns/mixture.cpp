// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/columns/mixture.hpp"

#include "engine/core/sum.hpp"
#include "engine/effects/fields.hpp"

#include <cmath>

namespace sturz {
namespace {

double pressure_at_release(const MixtureSettings& settings, double stress, double hydrostatic) {
  return settings.pressure_ratio < 0 ? hydrostatic : settings.pressure_ratio * stress;
}

}  // namespace

void add_mixture(State& state, std::size_t set, const MixtureSettings& settings) {
  MovingSet& p = state.sets[set];
  for (const FieldKey* key :
       {&fields::solids_volume, &fields::water_volume, &fields::solid_fraction,
        &fields::excess_pressure, &fields::pore_pressure, &fields::pore_gravity})
    p.add(*key);
  enter_mixture(p, settings, 0);
}

void enter_mixture(MovingSet& p, const MixtureSettings& settings, std::size_t first,
                   std::span<const Arrival> entering) {
  auto& solids = p.scalar(fields::solids_volume);
  auto& water = p.scalar(fields::water_volume);
  auto& fraction = p.scalar(fields::solid_fraction);
  Sum grains, fluid;
  for (std::size_t i = first; i < p.size(); ++i) {
    const double own =
        entering.empty() ? settings.solid_fraction : entering[i - first].solid_fraction;
    const double m = std::isnan(own) ? settings.solid_fraction : own;
    const double volume = p.mass[i] / settings.law.density(m);
    solids[i] = m * volume, water[i] = (1 - m) * volume, fraction[i] = m;
    grains.add(solids[i]), fluid.add(water[i]);
  }
  p.ledger.released_solids += grains.value();
  p.ledger.released_water += fluid.value();
}

void add_to_mixture(MovingSet& p, std::size_t i, const AddedMixture& added) {
  double &solids = p.scalar(fields::solids_volume)[i], &water = p.scalar(fields::water_volume)[i],
         &m = p.scalar(fields::solid_fraction)[i];
  const double skeleton = solids / m + added.solids_m3 / added.solid_fraction;
  solids += added.solids_m3, water += added.water_m3;
  m = solids / skeleton;
  p.scalar(fields::excess_pressure)[i] += added.excess_pa;
  p.ledger.released_solids += added.solids_m3;
  p.ledger.released_water += added.water_m3;
}

void start_pressure(ParticleSet& p, const MixtureSettings& settings, std::size_t i) {
  const double depth = p.scalar(fields::normal_gravity)[i] * p.scalar(fields::thickness)[i];
  const double volume = p.scalar(fields::solids_volume)[i] + p.scalar(fields::water_volume)[i];
  p.scalar(fields::pore_pressure)[i] =
      pressure_at_release(settings, p.mass[i] / volume * depth, settings.law.fluid_density * depth);
}

ColumnWater::ColumnWater(double solid_share, double m, double whole)
    : share(solid_share), thickness(whole * solid_share / m), level(whole) {
  if (m >= share) {
    film = whole - thickness;
  } else {
    saturation = m * (1 - share) / (share * (1 - m));
    level = saturation * thickness;
  }
}

WetBed::WetBed(ParticleSet& p, const MixtureSettings& settings, std::span<const double> strain_rate)
    : settings_(settings),
      mass_(p.mass.data()),
      thickness_(p.scalar(fields::thickness).data()),
      normal_gravity_(p.scalar(fields::normal_gravity).data()),
      solids_(p.scalar(fields::solids_volume).data()),
      water_(p.scalar(fields::water_volume).data()),
      strain_rate_(strain_rate.data()),
      fraction_(p.scalar(fields::solid_fraction).data()),
      excess_(p.scalar(fields::excess_pressure).data()),
      pressure_(p.scalar(fields::pore_pressure).data()),
      gravity_seen_(p.scalar(fields::pore_gravity).data()) {}

void WetBed::read(WetBlock& b, std::size_t begin) const {
  for (std::size_t k = 0; k < b.n; ++k) {
    const std::size_t i = begin + k;
    b.mass[k] = mass_[i], b.solids[k] = solids_[i], b.water[k] = water_[i];
    b.thickness[k] = thickness_[i], b.normal_gravity[k] = normal_gravity_[i];
    b.strain_rate[k] = strain_rate_[i], b.gravity_seen[k] = gravity_seen_[i];
    b.fraction[k] = fraction_[i], b.excess[k] = excess_[i];
  }
}

void WetBed::slide(WetBlock& b) const { b.slide(settings_); }

void WetBed::keep(const WetBlock& b, std::size_t k, std::size_t i) const {
  fraction_[i] = b.fraction[k];
  excess_[i] = b.excess[k];
  pressure_[i] = b.pressure[k];
  gravity_seen_[i] = normal_gravity_[i];
}

}  // namespace sturz
