// SPDX-License-Identifier: Apache-2.0
/// Grains and liquid as two sets of columns, built by hand.
#pragma once

#include "engine/core/sum.hpp"
#include "engine/effects/arrivals.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "engine/effects/phases/effect.hpp"
#include "tests/support/hand_made.hpp"

#include <array>
#include <utility>
#include <vector>

namespace sturz::test {

/// Columns of one phase on a lattice.
struct PhaseColumns {
  std::vector<Vec3> at;           ///< z does not count [m]
  std::vector<double> thickness;  ///< of this phase, vertical [m]
  Vec3 velocity{0, 0, 0};         ///< [m/s]
};

/// Grains of 2600 kg/m3 in water of 1000 kg/m3 on a bed without any friction or drag; columns of
/// 1 m.
inline TwoPhaseSettings frictionless_phases() {
  TwoPhaseSettings s;
  s.grains.density = s.drag.solid_density, s.liquid.density = s.drag.fluid_density;
  s.grains.bed[0].friction_coefficient = s.liquid.bed[0].friction_coefficient = 0;
  s.grains.instruction_set = s.liquid.instruction_set = best_instruction_set();
  return s;
}

/// \param settings  spacing of grains and liquid as their columns lie
inline HandMade phases_on(Terrain ground, const PhaseColumns& grains, const PhaseColumns& liquid,
                          const TwoPhaseSettings& settings, const Domain& domain = {},
                          int threads = 1) {
  HandMade made{State(std::move(ground), domain), {}};
  State& s = made.state;
  s.threads = threads;
  s.sets.resize(2);
  const std::array<const PhaseColumns*, 2> phases{&grains, &liquid};
  for (std::size_t k : {0, 1}) {
    MovingSet& p = s.sets[k];
    const PhaseColumns& from = *phases[k];
    const DepthAveragedSettings& of = k == 0 ? settings.grains : settings.liquid;
    p.name = k == 0 ? "grains" : "liquid";
    p.spacing = of.spacing, p.bulk_density = of.density;
    p.grow(from.at.size());
    for (std::size_t i = 0; i < from.at.size(); ++i) {
      p.x[i] = from.at[i].x(), p.y[i] = from.at[i].y();
      p.vx[i] = from.velocity.x(), p.vy[i] = from.velocity.y(), p.vz[i] = from.velocity.z();
      p.mass[i] = of.density * of.spacing * of.spacing * from.thickness[i];
    }
    mark_start(s.domain, p, 0);
    Sum mass;
    for (double m : p.mass) mass.add(m);
    p.ledger.released_mass = mass.value();
  }
  add_two_phases(made.step, s, settings, grains.thickness, liquid.thickness);
  for (MovingSet& p : s.sets) {
    refresh_motion(s, p, 0);
    p.ledger.kinetic_0 = p.ledger.kinetic;
  }
  return made;
}

inline Vec3 momentum_of(const MovingSet& p) {
  Sum sum[3];
  for (std::size_t i = 0; i < p.size(); ++i)
    sum[0].add(p.mass[i] * p.vx[i]), sum[1].add(p.mass[i] * p.vy[i]),
        sum[2].add(p.mass[i] * p.vz[i]);
  return {sum[0].value(), sum[1].value(), sum[2].value()};
}
inline double mass_of(const MovingSet& p) {
  Sum sum;
  for (double m : p.mass) sum.add(m);
  return sum.value();
}
inline double energy_of(const MovingSet& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    sum += 0.5 * p.mass[i] * (p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
  return sum;
}

}  // namespace sturz::test
