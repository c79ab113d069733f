// SPDX-License-Identifier: Apache-2.0
/// What the ground lets a column keep of the velocity that it is released with: v - (v . n) n.
#include "engine/simulation/parts.hpp"
#include "engine/simulation/simulation.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/catalogue.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace sturz {
namespace {

Scenario columns_on(double slope_deg, std::array<double, 3> velocity) {
  Scenario s = block_on_plane(0.3);
  s.formulation = Formulation::depth_averaged;
  s.terrain.synthetic->parameters["slope_deg"] = slope_deg;
  s.release.velocity_m_s = velocity;
  s.numerics.spacing_m = 2;
  return s;
}

/// The even velocity of all columns before the first step.
Vec3 start_of(const Scenario& s) {
  const Simulation simulation = assemble(s, load_scene_inputs(s), 0, 1);
  const MovingSet& p = simulation.parts().state.grains();
  const Vec3 v(p.vx[0], p.vy[0], p.vz[0]);
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_LT((Vec3(p.vx[i], p.vy[i], p.vz[i]) - v).norm(), 1e-9);
  return v;
}

TEST(ReleaseVelocity, StraightDownOnLevelGroundIsNothing) {
  const Scenario s = columns_on(0, {0, 0, -20});
  EXPECT_LT(start_of(s).norm(), 1e-12);
  const MemberResult r = assemble(s, load_scene_inputs(s), 0, 1).run();
  Scenario still = s;
  still.release.velocity_m_s = {0, 0, 0};
  const MemberResult same = assemble(still, load_scene_inputs(still), 0, 1).run();
  EXPECT_EQ(r.state_hash, same.state_hash);
}

TEST(ReleaseVelocity, StraightUpLiftsNoColumn) {
  EXPECT_LT(start_of(columns_on(0, {0, 0, 15})).norm(), 1e-12);
}

TEST(ReleaseVelocity, IntoASlopeKeepsItsPartAlongTheSlope) {
  // 20 m/s down on a slope of 30 degrees: 20 sin 30 = 10 m/s along it.
  const Vec3 v = start_of(columns_on(30, {0, 0, -20}));
  EXPECT_NEAR(v.x(), 10 * std::cos(std::asin(0.5)), 1e-6);
  EXPECT_NEAR(v.y(), 0, 1e-9);
  EXPECT_NEAR(v.z(), -5, 1e-6);
}

TEST(ReleaseVelocity, AlongTheSlopeIsKeptWhole) {
  const double c = std::cos(std::asin(0.5));
  const Vec3 v = start_of(columns_on(30, {12 * c, 3, -6}));
  EXPECT_NEAR(v.x(), 12 * c, 1e-6);
  EXPECT_NEAR(v.y(), 3, 1e-9);
  EXPECT_NEAR(v.z(), -6, 1e-6);
}

TEST(ReleaseVelocity, OfAHorizontalThrowTheSlopeKeepsTheCosine) {
  const Vec3 v = start_of(columns_on(30, {10, 0, 0}));
  EXPECT_NEAR(v.norm(), 10 * std::cos(std::asin(0.5)), 1e-6);
}

}  // namespace
}  // namespace sturz
