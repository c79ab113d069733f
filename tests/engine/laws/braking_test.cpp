// SPDX-License-Identifier: Apache-2.0
// A bed that brakes a column under a constant pull.
#include "engine/laws/braking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sturz {
namespace {

TEST(Braking, StopsAColumnAndDoesNotTurnIt) {
  const Vec3 none(0, 0, 0), v(3, 4, 0);
  EXPECT_EQ(braked(v, none, 2, 0, 2.5), none) << "5 m/s at 2 m/s^2";
  EXPECT_NEAR((braked(v, none, 2, 0, 2) - Vec3(0.6, 0.8, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(braked(none, Vec3(1, 0, 0), 1, 0, 1), none) << "a pull that friction holds";
  EXPECT_EQ(braked(none, none, 0, 0, 1), none);
}

TEST(Braking, WithARateIsTheExactSolution) {
  // dv/dt = a - p - k v from rest.
  const double a = 5, p = 2, k = 0.5, t = 3;
  EXPECT_NEAR(braked({0, 0, 0}, {a, 0, 0}, p, k, t).x(), (a - p) / k * (1 - std::exp(-k * t)),
              1e-12);
}

TEST(Braking, WhatIsNoNumberDoesNotRest) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(braked({1, 0, 0}, {0, 0, 0}, nan, 0, 1).x()));
  EXPECT_TRUE(std::isnan(braked({1, 0, 0}, {nan, 0, 0}, 1, 0, 1).x()));
}

}  // namespace
}  // namespace sturz
