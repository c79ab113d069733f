// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/earth_pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sturz {
namespace {

double tangent(double degrees) { return std::tan(degrees * std::numbers::pi / 180); }
double sine(double degrees) { return std::sin(degrees * std::numbers::pi / 180); }

TEST(EarthPressure, IsOneWithoutFriction) {
  const EarthPressure e;
  EXPECT_EQ(e.active, 1);
  EXPECT_EQ(e.passive, 1);
  EXPECT_FALSE(e.varies());
  const EarthPressure fluid(0, 0);
  EXPECT_EQ(fluid.active, 1);
  EXPECT_EQ(fluid.passive, 1);
}

TEST(EarthPressure, HasTheClosedFormsValues) {
  // phi = 30 deg, delta = 20 deg: cos^2 phi = 0.75, 1 + tan^2 delta = 1/cos^2 20.
  const double root = std::sqrt(1 - 0.75 * (1 + std::pow(tangent(20), 2)));
  const EarthPressure e(tangent(30), tangent(20));
  EXPECT_NEAR(e.active, 2 * (1 - root) / 0.75 - 1, 1e-14);
  EXPECT_NEAR(e.passive, 2 * (1 + root) / 0.75 - 1, 1e-14);
  EXPECT_NEAR(e.active, 0.631656, 1e-6);  // on a calculator
  EXPECT_NEAR(e.passive, 2.701678, 1e-6);
  EXPECT_TRUE(e.varies());
}

TEST(EarthPressure, ASmoothBaseGivesRankinesCoefficients) {
  for (const double phi : {10.0, 30.0, 45.0}) {
    const EarthPressure e(tangent(phi), 0);
    EXPECT_NEAR(e.active, (1 - sine(phi)) / (1 + sine(phi)), 1e-13);
    EXPECT_NEAR(e.passive, (1 + sine(phi)) / (1 - sine(phi)), 1e-12);
    EXPECT_NEAR(e.active * e.passive, 1, 1e-13);
  }
}

TEST(EarthPressure, ActiveAndPassiveMeetWhereTheBaseIsAsRoughAsTheMass) {
  const EarthPressure e(tangent(30), tangent(30));
  // sqrt of a rounding error of 1e-16
  EXPECT_NEAR(e.active, 5.0 / 3, 5e-8);
  EXPECT_NEAR(e.passive, 5.0 / 3, 5e-8);
}

TEST(EarthPressure, ABaseRougherThanTheMassCountsAsTheMass) {
  const EarthPressure e(tangent(30), tangent(40));
  EXPECT_EQ(e.active, e.passive);
  EXPECT_NEAR(e.active, 5.0 / 3, 1e-14);
  EXPECT_EQ(e.strained(1, 0.3, 200), e.active);
}

TEST(EarthPressure, AConstantOtherThanOneCountsAsVaryingWhateverItsRounding) {
  // Isotropic is K = 1: a rough bed holds K at 1 + 2 tan^2 phi, which is not that.
  for (double mu = 0.1; mu < 1; mu += 0.01) {
    EXPECT_TRUE(EarthPressure(mu, mu).varies()) << mu;
    EXPECT_TRUE(EarthPressure(mu, mu + 0.02).varies()) << mu;
  }
  EXPECT_FALSE(EarthPressure(0, 0.4).varies());
}

TEST(EarthPressure, PorePressureDrawsTowardsOne) {
  const EarthPressure dry(tangent(30), tangent(10));
  double active = dry.active, passive = dry.passive;
  for (const double ratio : {0.25, 0.5, 0.99}) {
    const EarthPressure wet = dry.with_pore_pressure(ratio);
    EXPECT_GT(wet.active, active);
    EXPECT_LT(wet.passive, passive);
    EXPECT_NEAR(1 - wet.active, (1 - ratio) * (1 - dry.active), 1e-14);
    active = wet.active, passive = wet.passive;
  }
  EXPECT_EQ(dry.with_pore_pressure(0).passive, dry.passive);
  EXPECT_EQ(dry.with_pore_pressure(1).passive, 1);
  EXPECT_EQ(dry.with_pore_pressure(1).active, 1);
}

TEST(EarthPressure, StretchingLowersItAndPushingTogetherRaisesIt) {
  const EarthPressure e(tangent(30), 0);  // 1/3 .. 3
  EXPECT_NEAR(e.strained(1, 0.001, 200), 0.8, 1e-15);
  EXPECT_NEAR(e.strained(1, -0.001, 200), 1.2, 1e-15);
  for (const double k : {e.active, 0.7, 1.0, 2.2, e.passive}) {
    EXPECT_EQ(e.strained(k, 0, 200), k) << "no strain, no change";
    for (const double strain : {-1.0, -0.01, 1e-4, 0.02, 5.0}) {
      EXPECT_GE(e.strained(k, strain, 200), e.active);
      EXPECT_LE(e.strained(k, strain, 200), e.passive);
    }
  }
  EXPECT_EQ(e.strained(1, 1, 200), e.active);
  EXPECT_EQ(e.strained(1, -1, 200), e.passive);
}

}  // namespace
}  // namespace sturz
