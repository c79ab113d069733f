// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/friction_cone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sturz {
namespace {

constexpr double degree = std::numbers::pi / 180;

MuIRheology sand(double slow_deg, double fast_deg) {
  MuIRheology law;
  law.static_friction = std::tan(slow_deg * degree);
  law.dynamic_friction = std::tan(fast_deg * degree);
  law.cohesion = 4000;
  return law;
}

TEST(FrictionCone, EachHoldsTheAngleWhereItSays) {
  for (const double angle : {0.0, 20.0, 33.0, 44.0}) {
    const double mu = std::tan(angle * degree);
    EXPECT_EQ(cone_slope(FrictionCone::simple_shear, mu), mu);
    const double slope = cone_slope(FrictionCone::plane_strain, mu);
    EXPECT_NEAR(plane_strain_angle(slope), angle * degree, 1e-14);
    EXPECT_NEAR(cone_cohesion(FrictionCone::plane_strain, mu, 4000),
                4000 * std::cos(angle * degree), 1e-10);
  }
}

TEST(FrictionCone, AngleAlongAPlaneActsAsALargerOneInPlaneStrain) {
  const auto acts_as = [](double angle) {
    return plane_strain_angle(cone_slope(FrictionCone::simple_shear, std::tan(angle * degree))) /
           degree;
  };
  EXPECT_NEAR(acts_as(25), 27.795, 5e-4);
  EXPECT_NEAR(acts_as(33), 40.497, 5e-4);
  EXPECT_TRUE(std::isinf(acts_as(46)));
}

TEST(FrictionCone, WhatASceneWithoutEitherKeyYieldsByIsWhatItGives) {
  const MuIRheology typed = sand(20.9, 32.8);
  const MuIRheology law = yielding_law(typed, FrictionCone::simple_shear, 0);
  EXPECT_EQ(law.static_friction, typed.static_friction);
  EXPECT_EQ(law.dynamic_friction, typed.dynamic_friction);
  EXPECT_EQ(law.inertial_number_scale, typed.inertial_number_scale);
  EXPECT_EQ(law.cohesion, typed.cohesion);
}

/// c + mu(I') p' of the pressure p' between the grains, at any rate.
TEST(FrictionCone, PorePressureLeavesTheLawOfThePressureBetweenTheGrains) {
  const MuIRheology typed = sand(20.9, 32.8);
  for (const FrictionCone cone : {FrictionCone::simple_shear, FrictionCone::plane_strain})
    for (const double ratio : {0.0, 0.3, 0.9}) {
      const MuIRheology dry = yielding_law(typed, cone, 0), wet = yielding_law(typed, cone, ratio);
      const double total = 3e4, between = (1 - ratio) * total;
      for (const double rate : {0.0, 0.1, 3.0, 100.0}) {
        const auto number = [&](double p) {
          return rate * typed.grain_diameter / std::sqrt(p / typed.grain_density);
        };
        EXPECT_NEAR(friction_at(wet, number(total)) * total,
                    friction_at(dry, number(between)) * between, 1e-9 * total)
            << ratio << " " << rate;
      }
      EXPECT_EQ(wet.cohesion, dry.cohesion);
    }
}

TEST(FrictionCone, PressureAtRestLiesInsideTheCone) {
  for (const FrictionCone cone : {FrictionCone::simple_shear, FrictionCone::plane_strain})
    for (const double angle : {10.0, 33.0, 39.0, 44.0, 60.0}) {
      const double slope = cone_slope(cone, std::tan(angle * degree));
      const double k0 = pressure_ratio_at_rest(cone, slope);
      EXPECT_LE((1 - k0) / std::sqrt(3.0), slope * (1 + 2 * k0) / 3 + 1e-14) << angle;
      if (cone == FrictionCone::simple_shear || angle < 39.3) {
        EXPECT_NEAR(k0, 1 - std::sin(angle * degree), 1e-14);
      }
    }
}

}  // namespace
}  // namespace sturz
