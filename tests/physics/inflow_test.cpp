// SPDX-License-Identifier: Apache-2.0
// Mass that enters over time, F1 to F5: even flow, discharges, volumes, a block's front, a late
// start.
#include "engine/effects/fields.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/physics/verification.hpp"
#include "tests/support/inflow_scene.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz::test {
namespace {

constexpr double slope = 20 * degree, width = 20, discharge = 40;

const char* const steady = "time_s,discharge_m3_s\n0,40\n300,40\n";

/// Where Voellmy's bed brakes as much as the slope drives: u^2 = xi h (sin - mu cos), q = h u.
struct EvenFlow {
  double drive = 80 * (std::sin(slope) - 0.1 * std::cos(slope)), q = discharge / width;
  double thickness = std::cbrt(q * q / drive), speed = std::sqrt(drive * thickness);
};

GaugeSpec point(const char* name, double x, double y) { return {name, {{{x, y}}}}; }
GaugeSpec across(const char* name, double x) { return {name, {{{x, -20}}, {{x, 20}}}}; }

/// Mean of a series from `from_s` on.
template <class Values>
double mean_after(const GaugeResult& g, const Values& values, double from_s) {
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < g.time_s.size(); ++i)
    if (g.time_s[i] > from_s) sum += values[i], n += 1;
  return sum / n;
}

void expect_accounts(const Finished& f) {
  const MemberScalars& m = f.result.scalars;
  EXPECT_LT(std::abs(m.mass_error), 1e-12);
  EXPECT_LT(std::abs(m.energy_residual), 0.01);
}

/// F1, F2: a steady inflow comes to the normal depth and speed, and as much passes below.
TEST(Inflow, ComesToTheEvenFlowOfVoellmysBed) {
  const EvenFlow even;
  for (const double spacing : {4.0, 2.0, 1.0}) {
    const SceneFolder folder;
    Scenario s = channel_with(folder, steady, spacing);
    s.numerics.end_time_s = 90;
    s.gauges.emplace();
    for (const double x : {10.0, 20.0, 30.0, 40.0})
      for (const double y : {-4.0, 0.0, 4.0})
        s.gauges->points.push_back(point(fmt::format("{} {}", x, y).c_str(), x, y));
    s.gauges->lines = {across("below", 30)};
    const Finished f = run(s);
    const GaugeResult& g = f.result.gauges;
    double thickness = 0, speed = 0;
    for (const PointSeries& p : g.points) {
      thickness += mean_after(g, p.thickness_m, 60) * std::cos(slope) / g.points.size();
      speed += mean_after(g, p.speed_m_s, 60) / g.points.size();
    }
    const double passed = mean_after(g, g.lines[0].discharge_m3_s, 60);
    fmt::print(
        "F1 spacing {} m: h {:.4f} m ({:+.2f} %), u {:.4f} m/s ({:+.2f} %), Q {:.3f} m3/s "
        "({:+.2f} %), {} columns\n",
        spacing, thickness, 100 * (thickness / even.thickness - 1), speed,
        100 * (speed / even.speed - 1), passed, 100 * (passed / discharge - 1),
        f.result.scalars.n_particles);
    EXPECT_NEAR(thickness, even.thickness, 0.05 * even.thickness) << spacing;
    EXPECT_NEAR(speed, even.speed, 0.05 * even.speed) << spacing;
    EXPECT_NEAR(passed, discharge, 0.02 * discharge) << spacing;
    EXPECT_TRUE(is_moving(f.result.censoring)) << "still entering is not at rest";
    EXPECT_NEAR(f.result.scalars.inflow_volume_m3, discharge * 90, 10 * spacing * spacing);
    expect_accounts(f);
  }
}

/// F3: what passed a line is what lies beyond it or left there.
TEST(Inflow, WhatPassedALineIsExactToAColumn) {
  const SceneFolder folder;
  Scenario s = channel_with(folder, "time_s,discharge_m3_s\n0,0\n10,60\n30,0\n", 2);
  s.gauges.emplace();
  s.gauges->lines = {across("below", 30), across("above", -60)};
  s.numerics.end_time_s = 45;
  const Finished f = run(s);
  const State& state = f.simulation.parts().state;
  const MovingSet& p = state.grains();
  double beyond = 0, all = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    all += p.mass[i] / p.bulk_density;
    if (p.x[i] > 30) beyond += p.mass[i] / p.bulk_density;
  }
  for (const Departure& gone : p.departures) {
    all += gone.mass / p.bulk_density;
    if (gone.x > 30) beyond += gone.mass / p.bulk_density;
  }
  EXPECT_NEAR(all, 900, 1e-9) << "half of 60 m3/s times 30 s";
  EXPECT_NEAR(f.result.scalars.inflow_volume_m3, 900, 1e-9);
  const GaugeResult& g = f.result.gauges;
  EXPECT_GT(beyond, 100);
  EXPECT_NEAR(g.lines[0].total_m3, beyond, 1e-9);
  EXPECT_NEAR(g.lines[0].volume_m3.back(), beyond, 1e-9);
  EXPECT_GT(g.lines[0].arrival_s, g.lines[1].arrival_s);
  EXPECT_GT(g.lines[0].discharge.value, 10);
  expect_accounts(f);
}

/// What has entered is the hydrograph's integral, at every instant, to half a column.
TEST(Inflow, FollowsTheIntegralOfItsHydrograph) {
  const SceneFolder folder;
  Scenario s = channel_with(folder, "time_s,discharge_m3_s\n2,0\n6,30\n8,30\n14,5\n20,0\n", 2);
  s.inflow[0].start_time_s = Uncertain(1);
  s.inflow[0].discharge_factor = Uncertain(1.5);
  s.numerics.end_time_s = 30;
  const SceneInputs in = load_scene_inputs(s);
  const HydrographVolume integral(in.inflow[0].hydrograph);
  Simulation simulation = assemble(s, in, 0, 1);
  const State& state = simulation.parts().state;
  // A column at the peak: 2 m x 2 m of critical flow of 45 m3/s over 20 m; the last may be half as
  // large again.
  const double q = 45 / width, column = 4 * std::cbrt(q * q / gravity_m_s2) / std::cos(slope);
  while (state.time < 25) {
    simulation.step();
    EXPECT_NEAR(state.ledger().added_volume, 1.5 * integral.until(state.time - 1), 0.76 * column)
        << state.time;
  }
  EXPECT_NEAR(state.ledger().added_volume, 1.5 * integral.total_m3(), 1e-9);
  EXPECT_NEAR(integral.total_m3(), 60 + 60 + 105 + 15, 1e-12);
  EXPECT_GT(state.ledger().added_momentum.x(), 0);
  EXPECT_LT(state.ledger().added_momentum.z(), 0) << "along the slope";
  EXPECT_EQ(state.grains().to_come, 0u);
}

/// Grains and water of the hydrograph enter a mixture, each kept by itself.
TEST(Inflow, BringsGrainsAndWaterIntoAMixture) {
  const SceneFolder folder;
  Scenario s =
      channel_with(folder, "time_s,discharge_m3_s,solid_fraction\n0,20,0.4\n20,20,0.6\n", 2);
  s.mixture.emplace();
  s.basal.turbulent_coefficient_m_s2.reset();
  s.basal.friction_coefficient = 0.6;
  s.numerics.end_time_s = 30;
  const Finished f = run(s);
  const Ledger ledger = f.simulation.parts().state.ledger();
  EXPECT_NEAR(ledger.released_solids, 0.5 * 400, 0.01 * 200) << "0.4 to 0.6 of 400 m3";
  EXPECT_NEAR(ledger.released_solids + ledger.released_water, 400, 1e-9);
  EXPECT_NEAR(ledger.added_mass, 2600 * ledger.released_solids + 1000 * ledger.released_water,
              1e-6);
  EXPECT_LT(std::abs(f.result.scalars.solids_error), 1e-12);
  EXPECT_LT(std::abs(f.result.scalars.water_error), 1e-12);
  EXPECT_GT(f.result.scalars.end_pore_pressure_ratio, 0.1);
  expect_accounts(f);
}

/// What enters takes its bed along like any other mass.
TEST(Inflow, ErodesTheBedThatItFlowsOver) {
  const SceneFolder folder;
  Scenario s = channel_with(folder, "time_s,discharge_m3_s\n0,20\n10,20\n", 2);
  s.erosion.emplace().growth_rate_per_m = Uncertain(0.002);
  s.erosion->supply = ErosionSupply::unlimited;
  s.numerics.end_time_s = 20;
  const Finished f = run(s);
  const MemberScalars& m = f.result.scalars;
  EXPECT_GT(m.volume_growth, 1.03);
  EXPECT_LT(m.volume_growth, std::exp(0.002 * 180 / std::cos(slope)));
  EXPECT_NEAR(m.inflow_volume_m3, 200, 1e-9);
  expect_accounts(f);
}

/// F4: a thin block arrives as a point mass does: s = a t^2 / 2.
TEST(Gauges, SeeTheFrontOfASlidingBlock) {
  Scenario s = block_on_plane();
  s.formulation = Formulation::depth_averaged;
  s.release.thickness_m = Uncertain(0.001);
  s.numerics.jitter = 0;
  s.numerics.end_time_s = 17;
  s.gauges.emplace();
  s.gauges->interval_s = 0.5;
  s.gauges->lines = {across("near", -30), across("far", 40), across("never", 75)};
  const Finished f = run(s);
  const double a =
      gravity_m_s2 * (std::sin(30 * degree) - std::tan(25 * degree) * std::cos(30 * degree));
  const GaugeResult& g = f.result.gauges;
  for (int k = 0; k < 2; ++k) {
    const double way = (g.lines[k].points[0].x() + 60.5) / std::cos(30 * degree);
    EXPECT_NEAR(g.lines[k].arrival_s, std::sqrt(2 * way / a), 0.01 * std::sqrt(2 * way / a)) << k;
    fmt::print("F4 line {}: {:.4f} s, block {:.4f} s\n", k, g.lines[k].arrival_s,
               std::sqrt(2 * way / a));
    EXPECT_NEAR(g.lines[k].total_m3, 0.1, 1e-9);
  }
  EXPECT_TRUE(std::isnan(g.lines[2].arrival_s)) << "never reached is no number";
  EXPECT_EQ(g.lines[2].total_m3, 0);
}

/// F5: the same release ten seconds later is the same slide ten seconds later.
TEST(LateRelease, IsTheSameSlideShiftedByItsStart) {
  const auto slide = [](double start_s) {
    Scenario s = ramp_slide();
    s.formulation = Formulation::depth_averaged;
    if (start_s > 0) s.release.start_time_s = Uncertain(start_s);
    s.gauges.emplace();
    s.gauges->lines = {{"foot", {{{0, -60}}, {{0, 60}}}}};
    return run(s);
  };
  const Finished now = slide(0), late = slide(10);
  const GaugeResult &a = now.result.gauges, &b = late.result.gauges;
  fmt::print(
      "F5: arrival {:.4f} and {:.4f} s, end {:.3f} and {:.3f} s, runout {:.2f} and {:.2f} m\n",
      a.lines[0].arrival_s, b.lines[0].arrival_s, now.result.scalars.end_time_s,
      late.result.scalars.end_time_s, now.result.scalars.runout_m, late.result.scalars.runout_m);
  EXPECT_NEAR(b.lines[0].arrival_s - a.lines[0].arrival_s, 10, 0.05);
  EXPECT_NEAR(b.lines[0].total_m3, a.lines[0].total_m3, 0.01 * a.lines[0].total_m3);
  EXPECT_EQ(late.result.outcome, Outcome::settled);
  EXPECT_NEAR(late.result.scalars.end_time_s, now.result.scalars.end_time_s + 10, 2);
  EXPECT_NEAR(late.result.scalars.com_travel_m, now.result.scalars.com_travel_m, 0.5);
  EXPECT_NEAR(late.result.scalars.deposit_area_m2, now.result.scalars.deposit_area_m2,
              0.03 * now.result.scalars.deposit_area_m2);
  EXPECT_NEAR(late.result.scalars.released_mass_kg, now.result.scalars.released_mass_kg,
              1e-12 * now.result.scalars.released_mass_kg);
  EXPECT_EQ(b.lines[0].volume_m3[9], 0) << "what has not started lies still";
  expect_accounts(late);
}

/// A mass at rest waits with the run for the one that starts later.
TEST(LateRelease, KeepsTheRunGoingUntilItStarts) {
  const SceneFolder folder;
  Scenario s = channel_with(folder, "time_s,discharge_m3_s\n60,20\n62,20\n", 2);
  s.domain.walls.clear();
  s.terrain.synthetic->parameters["slope_deg"] = 1;
  s.basal.friction_coefficient = 0.4;
  s.release.box = ReleaseBox{{-20, 0}, {-10, 10}};
  s.release.thickness_m = Uncertain(1);
  const Finished f = run(s);
  EXPECT_EQ(f.result.outcome, Outcome::settled);
  EXPECT_GT(f.result.scalars.end_time_s, 62);
  EXPECT_NEAR(f.result.scalars.inflow_volume_m3, 40, 1e-9);
}

TEST(Inflow, GivesTheSameBitsAtTwoThreads) {
  const SceneFolder folder;
  Scenario s = channel_with(folder, steady, 2);
  s.numerics.end_time_s = 20;
  const SceneInputs in = load_scene_inputs(s);
  EXPECT_EQ(assemble(s, in, 3, 2).run().state_hash, assemble(s, in, 3, 1).run().state_hash);
  EXPECT_NE(assemble(s, in, 3, 1).run().state_hash, assemble(s, in, 4, 1).run().state_hash)
      << "places follow the member";
}

}  // namespace
}  // namespace sturz::test
