// SPDX-License-Identifier: Apache-2.0
// V19 and V20 far from any ground: particles fly parabolas, pair forces do not move the whole.
#include "engine/effects/fields.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "engine/effects/motion/effect.hpp"
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz::test {
namespace {

constexpr double launch_height_m = 10;

/// Four particles at 20 m/s and 45 degrees, from far above the ground and far from each other.
Simulation launched(double spacing_m) {
  Scenario s;
  s.terrain.synthetic =
      SyntheticTerrain{"plane", spacing_m, {{"slope_deg", 0}, {"length_m", 100}, {"width_m", 24}}};
  s.release.box = ReleaseBox{{-40, -40 + spacing_m}, {-2 * spacing_m, 2 * spacing_m}};
  s.release.thickness_m = Uncertain(spacing_m);
  s.release.velocity_m_s = {20 * std::cos(45 * degree), 0, 20 * std::sin(45 * degree)};
  s.grains.emplace().friction_angle_deg = Uncertain(30);
  s.formulation = Formulation::full_stress;
  s.numerics.accept_unresolved = true;
  s.numerics.spacing_m = spacing_m;
  s.numerics.end_time_s = 2.8;
  s.numerics.stop_at_rest = false;
  Simulation simulation = build(s);
  ParticleSet& p = simulation.parts().state.grains();
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.y[i] = 5.0 * p.id[i] - 8;
    p.z[i] += launch_height_m;
  }
  return simulation;
}

/// Largest deviation from the range v^2/g, relative, when the particles are back at launch height.
std::pair<Finished, double> flight(double spacing_m) {
  Simulation simulation = launched(spacing_m);
  const ParticleSet start = simulation.parts().state.grains();
  std::vector<double> x0(start.size()), z0(start.size());
  for (std::size_t i = 0; i < start.size(); ++i)
    x0[start.id[i]] = start.x[i], z0[start.id[i]] = start.z[i];
  // To 2.8 s, shortly before they are back; then step by step.
  Finished f = run(std::move(simulation));
  ParticleSet& p = f.simulation.parts().state.grains();
  const double range = 400 / gravity_m_s2;
  double worst = 0;
  std::size_t back = 0;
  for (std::vector<double> x = p.x, z = p.z; back < p.size(); x = p.x, z = p.z) {
    f.simulation.step();
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double level = z0[p.id[i]];
      if (z[i] < level || p.z[i] >= level) continue;
      const double at = x[i] + (p.x[i] - x[i]) * (z[i] - level) / (z[i] - p.z[i]);
      worst = std::max(worst, std::abs((at - x0[p.id[i]]) / range - 1));
      ++back;
    }
    if (f.simulation.parts().state.time > 3.2) break;
  }
  EXPECT_EQ(back, p.size());
  return {std::move(f), worst};
}

TEST(FreeFlight, IsolatedParticlesFollowParabolas) {
  const auto [f, error] = flight(0.1);
  expect_within({"V19 isolated particles, dx 0.1 m", "range m", 400 / gravity_m_s2 * (1 + error),
                 400 / gravity_m_s2, error, 1e-4},
                f);
  expect_numerical_bounded("V19 isolated particles, dx 0.1 m", f);
}

/// The staggered velocity's first kick decides: its length is of the order of the step.
TEST(FreeFlight, WhatTheStepCostsIsReported) {
  for (const double dx : {1.0, 0.5}) {
    const auto [f, error] = flight(dx);
    const std::string name = fmt::format("V19 isolated particles, dx {} m", dx);
    record({name, "range m", 400 / gravity_m_s2 * (1 + error), 400 / gravity_m_s2, error}, f);
    expect_numerical_bounded(name, f);
    EXPECT_LT(error, 1e-3);
  }
}

/// A cohesive block that spins and shears in free space keeps its momentum.
TEST(FreeFlight, PairForcesDoNotMoveTheWhole) {
  Scenario s = block_on_plane();
  s.grains->cohesion_pa = 1e5;
  s.numerics.end_time_s = 2;
  s.numerics.stop_at_rest = false;
  Simulation simulation = build(s);
  State& state = simulation.parts().state;
  MovingSet& p = state.grains();
  state.gravity = 0;
  const MeanMotion centre = mean_motion(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double y = p.y[i] - centre.y, z = p.z[i] - centre.z;
    p.z[i] += 60;
    p.vx[i] = 3 + 0.1 * y;
    p.vy[i] = -0.5 * z;
    p.vz[i] = 0.5 * y;
  }
  p.components(fields::velocity_before) = {p.vx, p.vy, p.vz};
  refresh_motion(state, state.grains(), 0);
  const MeanMotion before = mean_motion(p);
  const Finished f = run(std::move(simulation));
  const MeanMotion after = mean_motion(f.simulation.parts().state.grains());
  const double drift =
      std::hypot(after.vx - before.vx, after.vy - before.vy, after.vz - before.vz) / before.speed;
  expect_within(
      {"V20 momentum of a spinning block", "relative drift in 2 s", drift, 0, drift, 1e-7}, f);
  expect_conserved("V20 spinning block", f);
}

}  // namespace
}  // namespace sturz::test
