// SPDX-License-Identifier: Apache-2.0
// The exponential that loops can run four side by side, against that of the library.
#include "engine/core/plain_exp.hpp"

#include "engine/core/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sturz {
namespace {

TEST(PlainExp, IsTheExponential) {
  for (int i = 0; i < 100000; ++i) {
    const double range = i % 3 == 0 ? 690 : i % 3 == 1 ? 5 : 0.01;
    const double x = range * (2 * unit_random(1, 0, i) - 1);
    ASSERT_NEAR(plain_exp(x) / std::exp(x), 1, 5e-16) << x;
  }
  EXPECT_EQ(plain_exp(0), 1);
  EXPECT_LT(plain_exp(-1e300), 1e-300);
  EXPECT_TRUE(std::isfinite(plain_exp(1e300)));
  EXPECT_TRUE(std::isnan(plain_exp(std::nan("")))) << "what is broken is not hidden";
}

TEST(PlainExp, DecaysAsTheClosedForms) {
  for (int i = 0; i < 20000; ++i) {
    const double x = (i % 2 ? 30 : 0.2) * (2 * unit_random(2, 0, i) - 1);
    if (std::abs(x) < 1e-6) continue;
    const long double left = std::exp(-static_cast<long double>(x)),
                      mean = -std::expm1(-static_cast<long double>(x)) / x, lag = (1 - mean) / x;
    const Decay d = decay_over(x);
    ASSERT_NEAR(d.left / static_cast<double>(left), 1, 1e-15) << x;
    ASSERT_NEAR(d.mean / static_cast<double>(mean), 1, 1e-14) << x;
    ASSERT_NEAR(d.lag / static_cast<double>(lag), 1, 1e-12) << x;
  }
  const Decay none = decay_over(0);
  EXPECT_EQ(none.left, 1);
  EXPECT_EQ(none.mean, 1);
  EXPECT_EQ(none.lag, 0.5);
}

TEST(PlainExp, HasNoJumpWhereTheSeriesEnds) {
  for (double edge : {-0.0625, 0.0625}) {
    const Decay in = decay_over(std::nextafter(edge, 0)), out = decay_over(edge);
    // The closed forms subtract e^-x from one: eps/x, and that over x once more.
    EXPECT_NEAR(in.mean, out.mean, 4e-15);
    EXPECT_NEAR(in.lag, out.lag, 1e-13);
  }
}

TEST(PlainExp, GivesTheSameBitsSideBySideAndAlone) {
  std::vector<double> x(1027), together(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = 40 * (unit_random(3, 0, static_cast<int>(i)) - 0.5);
#pragma omp simd
  for (std::size_t i = 0; i < x.size(); ++i) together[i] = plain_exp(x[i]);
  for (std::size_t i = 0; i < x.size(); ++i) {
    volatile double alone = x[i];
    EXPECT_EQ(together[i], plain_exp(alone));
  }
}

}  // namespace
}  // namespace sturz
