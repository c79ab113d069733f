// SPDX-License-Identifier: Apache-2.0
// Columns of a mixture: whether a sheet runs or sticks (T4), a dam break with frozen pressure (T6),
// the same bits at any number of threads.
#include "engine/effects/fields.hpp"
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"
#include "tests/support/wet_box.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace sturz::test {
namespace {

constexpr double slope_deg = 31;

/// One metre of the flume's mixture along the normal on an endless slope.
Scenario wet_sheet(double solid_fraction, double spacing_m) {
  Scenario s;
  const double side = 12;
  s.terrain.synthetic = SyntheticTerrain{
      "plane", 1, {{"slope_deg", slope_deg}, {"length_m", side}, {"width_m", side}}};
  s.formulation = Formulation::depth_averaged;
  s.release.box = ReleaseBox{{-side / 2, side / 2}, {-side / 2, side / 2}};
  s.release.thickness_m = Uncertain(1 / std::cos(slope_deg * degree));
  s.grains.emplace().density_kg_m3 = 2700;
  s.grains->solid_fraction = solid_fraction;
  s.mixture.emplace().fluid_density_kg_m3 = 1100;
  s.basal.friction_coefficient = std::tan(40 * degree);
  s.domain.periodic = {"x", "y"};
  s.numerics.spacing_m = spacing_m;
  s.numerics.end_time_s = 10;
  s.numerics.stop_at_rest = false;
  return s;
}

/// Largest errors of speed and path against the sheet alone, after 1, 2, 5 and 10 s.
struct Errors {
  double speed = 0, path = 0;
};

Errors compare(double solid_fraction, double spacing_m) {
  WetBox box(flume_mixture(), solid_fraction, slope_deg);
  Errors worst;
  double now = 0;
  const double c = std::cos(slope_deg * degree);
  const auto look = [&](double time, const SimulationParts& parts) {
    const MovingSet& p = parts.state.grains();
    const MeanMotion m = mean_motion(p);
    // Velocities stand half a step before the time of a look.
    const double half_step_ago = time - 0.5 * parts.state.previous_dt;
    constexpr double dt = 1e-3;
    for (; now + dt <= half_step_ago; now += dt) box.slide(dt);
    if (half_step_ago > now) box.slide(half_step_ago - now), now = half_step_ago;
    const auto near = [time](double t) { return std::abs(time - t) < 0.2; };
    if (!near(1) && !near(2) && !near(5) && !near(10)) return;
    const double speed_there = box.speed;
    const double box_path = box.path + 0.5 * parts.state.previous_dt * box.speed;
    worst.speed =
        std::max(worst.speed, std::abs(m.vx / c - speed_there) / std::max(0.5, speed_there));
    double path = 0;  // periods are crossed: from each column's own start
    for (std::size_t i = 0; i < p.size(); ++i)
      path += (p.x[i] + p.wrapped_x[p.id[i]] - p.start_x[p.id[i]]) / c / p.size();
    worst.path = std::max(worst.path, std::abs(path - box_path) / box_path);
  };
  const Finished f = run(build(wet_sheet(solid_fraction, spacing_m)), {1, look});
  expect_conserved(f);
  EXPECT_LE(std::abs(f.result.scalars.solids_error), 1e-13);
  EXPECT_LE(std::abs(f.result.scalars.water_error), 1e-13);
  fmt::print("T4 columns, m0 = {:.2f}, dx = {:.2f} m, dt = {:.3f} s: speed {:.2g}, path {:.2g}\n",
             solid_fraction, spacing_m, f.result.scalars.mean_dt_s, worst.speed, worst.path);
  return worst;
}

class WetSheets : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(SolidFractions, WetSheets, testing::Values(.55, .60, .62, .64, .66),
                         [](const auto& i) { return fmt::format("Percent{:.0f}", 100 * i.param); });

TEST_P(WetSheets, RunOrStickAsTheSheetAlone) {  // T4
  for (const double spacing : {1.0, 0.5}) {
    const Errors e = compare(GetParam(), spacing);
    EXPECT_LT(e.speed, 0.005) << spacing;
    EXPECT_LT(e.path, 0.005) << spacing;
  }
}

/// Thickness and front of a dam break along the slope.
struct DamBreak {
  std::vector<double> x, h;
  double front = 0;
};

/// 20 m of mass behind a dam on a 22 degree slope, 5 s after it is gone.
Scenario dam(double friction) {
  Scenario s = block_on_plane(friction);
  const double spacing = 2, width = 10 * spacing;
  s.formulation = Formulation::depth_averaged;
  s.terrain.synthetic = SyntheticTerrain{
      "plane", 2 * spacing, {{"slope_deg", 22}, {"length_m", 800}, {"width_m", width}}};
  s.release.box = ReleaseBox{{-260, 0}, {-width / 2, width / 2}};
  s.release.thickness_m = Uncertain(20 / std::cos(22 * degree));
  s.domain.periodic = {"y"};
  s.numerics.spacing_m = spacing;
  s.numerics.jitter = 0;
  s.numerics.end_time_s = 5;
  s.numerics.stop_at_rest = false;
  return s;
}

/// \param lambda pore pressure over weight that is put back before every step; negative: dry
DamBreak break_dam(const Scenario& s, double lambda) {
  Simulation simulation = build(s);
  State& state = simulation.parts().state;
  MovingSet& p = state.grains();
  while (state.time < 5) {
    if (lambda >= 0 && state.n_steps > 0)
      for (std::size_t i = 0; i < p.size(); ++i) {
        p.scalar(fields::excess_pressure)[i] =
            (lambda * p.bulk_density - s.mixture->fluid_density_kg_m3.value) *
            p.scalar(fields::normal_gravity)[i] * p.scalar(fields::thickness)[i];
        p.scalar(fields::solid_fraction)[i] = s.grains->solid_fraction.value;
      }
    const double dt = simulation.parts().step.limit(state).dt;
    simulation.parts().step.apply(
        state,
        std::min({dt, 5 - state.time, state.previous_dt > 0 ? 1.05 * state.previous_dt : dt}));
  }
  DamBreak out;
  for (std::size_t i = 0; i < p.size(); ++i) {
    out.x.push_back(p.x[i]), out.h.push_back(p.scalar(fields::thickness)[i]);
    if (out.h.back() > 1) out.front = std::max(out.front, p.x[i] / std::cos(22 * degree));
  }
  return out;
}

TEST(WetDamBreak, WithFrozenPressureIsTheDryOneWithLessFriction) {  // T6
  for (const double lambda : {0.5, 1.0}) {
    const double friction = std::tan(35 * degree);
    Scenario wet = dam(friction);
    wet.grains->solid_fraction = 0.6;
    wet.mixture.emplace().initial_pressure_ratio = Uncertain(lambda);
    // Neither dilates nor drains: critical, and thin as air.
    wet.mixture->critical_solid_fraction = 0.6;
    wet.mixture->fluid_viscosity_pa_s = 1e-9;
    wet.mixture->permeability_m2 = 1e-30;
    const DamBreak mixture = break_dam(wet, lambda),
                   dry = break_dam(dam(friction * (1 - lambda)), -1);
    ASSERT_EQ(mixture.x.size(), dry.x.size());
    double difference = 0, scale = 0;
    for (std::size_t i = 0; i < dry.x.size(); ++i)
      difference += std::abs(mixture.h[i] - dry.h[i]), scale += dry.h[i];
    fmt::print("T6 lambda {}: front {:.3f} m, dry {:.3f} m; thickness {:.2g}\n", lambda,
               mixture.front, dry.front, difference / scale);
    EXPECT_NEAR(mixture.front, dry.front, 0.01 * dry.front);
    EXPECT_LT(difference / scale, 0.01);
  }
}

TEST(WetColumns, GiveTheSameBitsAtAnyNumberOfThreads) {
  Scenario s = ramp_slide(90, 3);
  s.formulation = Formulation::depth_averaged;
  s.mixture.emplace();
  s.grains->solid_fraction = 0.6;
  s.basal.friction_coefficient = std::tan(35 * degree);
  s.numerics.end_time_s = 6;
  const Finished one = run(build(s, 1)), three = run(build(s, 3));
  EXPECT_EQ(one.result.state_hash, three.result.state_hash);
  expect_conserved(one);
  Scenario other = s;
  other.mixture->permeability_m2 = 2e-10;
  EXPECT_NE(run(build(other)).result.state_hash, one.result.state_hash);
}

TEST(WetColumns, GiveTheSameBitsWithAResolvedProfileToo) {
  Scenario s = ramp_slide(90, 3);
  s.formulation = Formulation::depth_averaged;
  s.mixture.emplace().pressure_profile = PressureProfile::resolved;
  s.grains->solid_fraction = 0.6;
  s.basal.friction_coefficient = std::tan(35 * degree);
  s.numerics.end_time_s = 6;
  const Finished one = run(build(s, 1)), two = run(build(s, 2));
  EXPECT_EQ(one.result.state_hash, two.result.state_hash);
  expect_conserved(one);
  EXPECT_LE(std::abs(one.result.scalars.solids_error), 1e-13);
  EXPECT_LE(std::abs(one.result.scalars.water_error), 1e-13);
  for (auto change : {+[](MixtureSpec& wet) { wet.pressure_profile = PressureProfile::parabola; },
                      +[](MixtureSpec& wet) { wet.pressure_nodes = 6; },
                      +[](MixtureSpec& wet) { wet.drainage = Drainage::both; }}) {
    Scenario other = s;
    change(*other.mixture);
    EXPECT_NE(run(build(other)).result.state_hash, one.result.state_hash);
  }
}

}  // namespace
}  // namespace sturz::test
