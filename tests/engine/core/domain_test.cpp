// SPDX-License-Identifier: Apache-2.0
#include "engine/core/domain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sturz {
namespace {

Domain tilted() {
  Domain d;
  d.x = {true, -5, 7, -3};
  return d;
}

TEST(Domain, WrapsBackByWholePeriods) {
  const Domain d = tilted();
  for (double start : {-5.0, 0.0, 6.999})
    for (int turns : {-7, -1, 0, 1, 4}) {
      double x = start + 12 * turns, y = 99, z = 1 - 3.0 * turns;
      d.wrap(x, y, z);
      EXPECT_NEAR(x, start, 1e-12);
      EXPECT_NEAR(z, 1, 1e-12);
      EXPECT_EQ(y, 99);
    }
}

TEST(Domain, APointOnTheFarEdgeEntersAtTheNearOne) {
  double x = 7, y = 0, z = 0;
  tilted().wrap(x, y, z);
  EXPECT_EQ(x, -5);
  EXPECT_EQ(z, 3);
}

TEST(Domain, PointsInsideKeepTheirBits) {
  double x = 0.1 + 0.2, y = 1e7, z = 1.0 / 3;
  tilted().wrap(x, y, z);
  EXPECT_EQ(x, 0.1 + 0.2);
  EXPECT_EQ(z, 1.0 / 3);
}

TEST(Domain, ARunawayPointComesBackAtOnceOrTurnsNaN) {
  // A member that diverges must end as diverged, not hang in the wrapping.
  for (double far : {1e12, -1e15, 1e300, -1e300}) {
    double x = far, y = 0, z = 0;
    tilted().wrap(x, y, z);
    EXPECT_TRUE(!std::isfinite(x) || std::abs(x) <= std::abs(far));
  }
  double x = std::numeric_limits<double>::infinity(), y = 0, z = 0;
  tilted().wrap(x, y, z);
  EXPECT_FALSE(std::isfinite(x));
}

}  // namespace
}  // namespace sturz
