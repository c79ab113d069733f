// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/entrainment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sturz {
namespace {

constexpr double degree = std::numbers::pi / 180;
using Law = Entrainment::Law;

FlowOverBed flow_on(double slope_deg, double h, double speed, double density, double friction) {
  FlowOverBed flow;
  flow.thickness = h, flow.speed = speed, flow.density = density;
  flow.normal_gravity = standard_gravity * std::cos(slope_deg * degree);
  flow.drive = standard_gravity * std::sin(slope_deg * degree);
  flow.brake = friction * flow.normal_gravity;
  return flow;
}

TEST(Entrainment, GrowsTheVolumeByThePath) {
  Entrainment law;
  law.growth_rate = 1e-3;
  EXPECT_DOUBLE_EQ(law.erosion_rate(flow_on(25, 2, 20, 1800, 0.2), 1500), 0.04);
}

TEST(Entrainment, LiquefiedBedByTheJumpOfMomentum) {
  Entrainment law;
  law.law = Law::momentum_jump;
  law.bed_friction = 0.8;
  const FlowOverBed flow = flow_on(31, 1, 8, 2000, 0.8 * (1 - 0.8));
  EXPECT_NEAR(law.erosion_rate(flow, 2000), 0.33635, 5e-6);
  EXPECT_NEAR(law.erosion_rate(flow, 1000), 0.67270, 1e-5) << "a lighter bed goes faster";
  law.bed_pressure_ratio = 0.9;
  EXPECT_NEAR(law.erosion_rate(flow, 2000), 0.33635 / 2, 5e-6) << "half of the jump is left";
}

TEST(Entrainment, TakesNothingWhereTheBedResistsAsMuchAsTheFlowPulls) {
  Entrainment law;
  law.law = Law::momentum_jump;
  law.bed_friction = 0.8;
  for (const double ratio : {0.8, 0.5, 0.0}) {
    law.bed_pressure_ratio = ratio;
    EXPECT_EQ(law.erosion_rate(flow_on(31, 1, 8, 2000, 0.8 * (1 - 0.8)), 2000), 0) << ratio;
  }
}

TEST(Entrainment, DepthThatTheShearStressTakes) {
  Entrainment law;
  law.law = Law::shear_stress;
  const FlowOverBed flow = flow_on(10, 2, 5, 2000, 0.1);
  EXPECT_NEAR(flow.density * flow.thickness * flow.drive, 6813.95, 0.01);
  EXPECT_NEAR(law.most_depth(flow), 0.58140, 5e-6);
  EXPECT_DOUBLE_EQ(law.erosion_rate(flow, 1500), 0.025);
  EXPECT_NEAR(law.most_depth(flow) / law.rate, 23.26, 0.005);
  EXPECT_EQ(law.erosion_rate(flow_on(10, 0.29, 5, 2000, 0.1), 1500), 0) << "below 1 kPa";
  EXPECT_EQ(law.erosion_rate(flow_on(-10, 2, 5, 2000, 0.1), 1500), 0) << "uphill";
}

TEST(Entrainment, NothingAtRest) {
  for (const Law kind : {Law::exponential, Law::shear_stress, Law::momentum_jump}) {
    Entrainment law;
    law.law = kind;
    law.growth_rate = 1;
    EXPECT_EQ(law.erosion_rate(flow_on(40, 5, 0, 2000, 0.1), 1500), 0);
    EXPECT_EQ(law.erosion_rate(flow_on(40, 0, 5, 2000, 0.1), 1500), 0) << "no flow";
  }
  Entrainment jump;
  jump.law = Law::momentum_jump;
  EXPECT_EQ(jump.erosion_rate(flow_on(40, 5, 0.09, 2000, 0.1), 1500), 0);
  EXPECT_GT(jump.erosion_rate(flow_on(40, 5, 0.11, 2000, 0.1), 1500), 0);
}

}  // namespace
}  // namespace sturz
