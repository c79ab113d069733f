// SPDX-License-Identifier: Apache-2.0
#include "engine/core/plain_log.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

TEST(PlainLog, IsTheLogarithm) {
  for (double x = 1e-12; x < 1e12; x *= 1.0173)
    ASSERT_NEAR(plain_log(x), std::log(x), 5e-16 * std::fmax(1e-3, std::abs(std::log(x)))) << x;
  for (double x = 0.7; x < 1.42; x += 1e-3)
    ASSERT_NEAR(plain_log(x), std::log(x), 4e-16 * std::abs(std::log(x)) + 1e-18) << x;
  EXPECT_EQ(plain_log(1), 0);
}

TEST(PlainLog, RaisesToPowers) {
  for (double x = 1e-9; x < 1e9; x *= 1.31)
    for (const double p : {-2.65, -1.65, 0.687})
      ASSERT_NEAR(plain_pow(x, p) / std::pow(x, p), 1, 1e-14) << x << " " << p;
  EXPECT_LT(plain_pow(0, 0.687), 1e-200);
}

/// Alone as in a loop that the compiler may have laid out over lanes.
TEST(PlainLog, HasTheSameBitsInALoop) {
  double many[13], alone[13];
  for (int k = 0; k < 13; ++k) many[k] = plain_log(0.3 + 0.77 * k);
  for (int k = 12; k >= 0; --k) {
    volatile double x = 0.3 + 0.77 * k;
    alone[k] = plain_log(x);
  }
  for (int k = 0; k < 13; ++k) EXPECT_EQ(many[k], alone[k]);
}

}  // namespace
}  // namespace sturz
