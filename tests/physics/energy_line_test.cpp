// SPDX-License-Identifier: Apache-2.0
// V2 and V21: a mass slides down a smooth ramp, and it does not matter which way the ramp points.
#include "scenarios/catalogue.hpp"
#include "tests/physics/descent.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace sturz::test {
namespace {

/// A disc that keeps its shape: the energy line knows no friction but the bed's.
Scenario disc(double artificial_viscosity) {
  Scenario s = ramp_slide(90, 2);
  s.release.thickness_m = Uncertain(6);
  s.grains->cohesion_pa = 1e7;
  s.grains->friction.reset();
  s.grains->friction_angle_deg = Uncertain(89);
  s.numerics.artificial_viscosity = artificial_viscosity;
  return s;
}

TEST(EnergyLine, DiscEndsWhereAMassPointEnds) {
  const Descent d = descend(disc(0.1));
  const EnergyLine line(d.s0, true), straight(d.s0, false);
  expect_within({"V2 disc, angle", "deg", d.angle_deg(), line.angle_deg(),
                 d.angle_deg() - line.angle_deg(), 0.5},
                d.finished);
  expect_within({"V2 disc, energy height", "rms m", drop_m * d.rmse(line), 0, d.rmse(line), 0.02},
                d.finished);
  record({"V2 disc, angle against the straight line", "deg", d.angle_deg(), straight.angle_deg(),
          d.angle_deg() - straight.angle_deg()},
         d.finished);
  expect_conserved("V2 disc", d.finished);
}

TEST(EnergyLine, HalfTheViscosityIsReported) {
  const Descent d = descend(disc(0.05));
  const EnergyLine line(d.s0, true);
  expect_within({"V2 disc, viscosity 0.05, angle", "deg", d.angle_deg(), line.angle_deg(),
                 d.angle_deg() - line.angle_deg(), 0.5},
                d.finished);
  expect_conserved("V2 disc, viscosity 0.05", d.finished);
}

/// Loose grains lose energy among themselves too, so their line is steeper than the bed's.
TEST(EnergyLine, LooseMassStopsEarlierThanADisc) {
  for (const double viscosity : {0.1, 0.05}) {
    Scenario s = ramp_slide(90, 3);
    s.numerics.artificial_viscosity = viscosity;
    const Descent d = descend(s);
    const EnergyLine line(d.s0, true);
    const std::string name = fmt::format("V2 loose mass, viscosity {}", viscosity);
    record({name + ", angle", "deg", d.angle_deg(), line.angle_deg(),
            d.angle_deg() - line.angle_deg()},
           d.finished);
    EXPECT_GT(d.angle_deg(), line.angle_deg());
    EXPECT_LT(d.angle_deg(), line.angle_deg() + 2);
    expect_conserved(name, d.finished);
  }
}

TEST(RotationInvariance, RunOutDoesNotKnowTheGrid) {
  double travel = 0, front = 0;
  for (const double azimuth : {90.0, 60.0, 45.0}) {
    const Descent d = descend(ramp_slide(azimuth, 3), azimuth);
    const double mean = d.s.back() - d.s0, farthest = d.finished.result.scalars.front_travel_m;
    if (azimuth == 90) travel = mean, front = farthest;
    const std::string name = fmt::format("V21 ramp turned by {:.0f} deg", 90 - azimuth);
    expect_within(relative(name + ", centre of mass", "m", mean, travel, 0.02), d.finished);
    expect_within(relative(name + ", front", "m", farthest, front, 0.02), d.finished);
    expect_conserved(name, d.finished);
  }
}

}  // namespace
}  // namespace sturz::test
