// SPDX-License-Identifier: Apache-2.0
// A pool that starts at rest stays there. The bounds were set before anything was run.
#include "scenarios/assembly/assemble.hpp"
#include "tests/physics/verification.hpp"
#include "tests/support/liquid/pool_tank.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace sturz::test {
namespace {

/// Largest speed over all of a second in a tank 1 m deep, over that of a fall from there.
void expect_rest(const std::string& name, const Scenario& s, double bound) {
  Simulation run = assemble(s, level(s), 0, 1);
  double most = 0;
  while (run.parts().state.time < 1) {
    run.step();
    most = std::max(most, run.parts().state.max_speed());
  }
  EXPECT_EQ(run.parts().state.ledger().lost_mass, 0);
  const double share = most / std::sqrt(2 * gravity_m_s2 * deep);
  expect_within({"pool at rest, " + name, "largest speed / that of a fall from its depth", share, 0,
                 share, bound});
}

TEST(StandingWater, StaysAtRest) {
  Scenario water = tank();
  water.grains.reset();
  expect_rest("water", water, 2e-3);
  water.numerics.jitter = 0.05;
  expect_rest("water, jittered lattice", water, 2e-2);
}

TEST(StandingWater, AStrongColumnInItStands) {
  Scenario s = tank();
  s.grains->friction_angle_deg = Uncertain(60);
  s.basal.friction_coefficient = Uncertain(2);
  expect_rest("strong column", s, 1e-2);
}

}  // namespace
}  // namespace sturz::test
