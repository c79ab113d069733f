// SPDX-License-Identifier: Apache-2.0
// Grains and liquid are stable at the step that the lattice's fastest wave allows, by the margin
// that either material has alone.
#include "tests/support/liquid/immersed_grains.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace sturz::test {
namespace {

/// A box at rest under its weight, periodic; drag of large grains damps little.
ImmersedGrains box(double solids, bool buoyancy, bool coupled) {
  ImmersedGrains g;
  g.spacing = 0.1;
  g.grain_length = g.liquid_length = 0.4;
  g.grain_height = g.liquid_height = 0.6;
  g.across = 4;
  g.solid_fraction = solids;
  g.drag_diameter = 0.3;
  g.buoyancy = buoyancy;
  g.coupled = coupled;
  g.grain_friction = 20;
  return g;
}

/// Kinetic energy over m g H after some steps of so many times their limit; endless where it blew
/// up.
double restless(const ImmersedGrains& g, double times, int steps) {
  HandMade made = immersed(g);
  double mass = 0;
  for (const MovingSet& p : made.state.sets) mass += p.ledger.released_mass;
  for (int n = 0; n < steps; ++n) {
    const double limit = times * made.step.limit(made.state).dt, last = made.state.previous_dt;
    made.step.apply(made.state, last > 0 ? std::min(limit, 1.05 * last) : limit);
    const double share = made.state.ledger().kinetic / (mass * standard_gravity * g.grain_height);
    if (!(share < 1)) return 1e300;
  }
  return made.state.ledger().kinetic / (mass * standard_gravity * g.grain_height);
}

TEST(StepAmongGrains, HasAMargin) {
  for (const bool buoyancy : {false, true})
    for (const double solids : {0.3, 0.6})
      EXPECT_LT(restless(box(solids, buoyancy, true), 2, 400), 1e-3) << buoyancy << " " << solids;
}

}  // namespace
}  // namespace sturz::test
