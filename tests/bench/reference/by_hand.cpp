// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/reference/by_hand.hpp"

#include "engine/effects/motion/accounts.hpp"
#include "engine/effects/motion/effect.hpp"
#include "engine/effects/motion/gravity.hpp"

namespace sturz::bench {
namespace {

State particles_of(const Release& release, const Terrain& bed) {
  State s(bed, Domain{});
  MovingSet& p = s.grains();
  p.grow(release.x.size());
  p.x = release.x, p.y = release.y, p.z = release.z;
  p.mass = release.mass;
  for (double m : p.mass) s.grains().ledger.released_mass += m;
  return s;
}

}  // namespace

ByHand by_hand(const ScenePlan& plan) {
  ByHand made{particles_of(plan.release, plan.bed), {}};
  State& s = made.state;
  if (plan.formulation.depth_averaged) {
    DepthAveragedSettings settings = plan.columns;
    settings.bed.resize(1);
    settings.earth_pressure.assign(1, EarthPressure{});
    settings.zones = {};
    add_depth_averaged(made.step, s, 0, settings, plan.release.thickness);
  } else {
    ContactSettings contact = plan.contact;
    contact.bed.resize(1);
    contact.zones = {};
    add_grain_stress(made.step, s, 0, plan.stress, plan.release.depth);
    add_gravity(made.step, s, 0);
    add_terrain_contact(made.step, 0, contact);
    if (!s.domain.walls.empty()) add_wall_contact(made.step, 0, contact);
    add_motion(made.step, 0, {plan.stress.spacing, plan.stress.smoothing_length});
  }
  refresh_motion(s, s.grains(), 0);
  s.grains().ledger.kinetic_0 = s.grains().ledger.kinetic;
  return made;
}

}  // namespace sturz::bench
