// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/wilson.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

TEST(Wilson, MatchesPublishedIntervals) {
  const struct {
    int hits, trials;
    double lower, upper;
  } known[] = {{0, 20, 0, 0.161125},          {10, 20, 0.299298, 0.700702}, {20, 20, 0.838875, 1},
               {1, 29, 0.006113, 0.171755},  // Newcombe (1998), table I
               {81, 263, 0.255257, 0.366187}, {15, 148, 0.062387, 0.160508}};
  for (const auto& [hits, trials, lower, upper] : known) {
    const ProbabilityBounds bounds = wilson_interval(hits, trials);
    EXPECT_NEAR(bounds.lower, lower, 5e-5) << hits << " of " << trials;
    EXPECT_NEAR(bounds.upper, upper, 5e-5) << hits << " of " << trials;
  }
}

TEST(Wilson, SolvesTheScoreEquation) {
  constexpr double z = 1.959963984540054;
  for (const int n : {2, 20, 500})
    for (int k = 1; k < n; k += 1 + n / 7) {
      const double share = static_cast<double>(k) / n;
      const ProbabilityBounds bounds = wilson_interval(k, n);
      for (const double p : {bounds.lower, bounds.upper})
        EXPECT_NEAR(std::abs(share - p), z * std::sqrt(p * (1 - p) / n), 1e-12);
    }
}

TEST(Wilson, IsExactAtTheEnds) {
  for (const int n : {1, 3, 7, 1000, 123457}) {
    EXPECT_EQ(wilson_interval(0, n).lower, 0);
    EXPECT_EQ(wilson_interval(n, n).upper, 1);
    EXPECT_NEAR(wilson_interval(0, n).upper, 1 - wilson_interval(n, n).lower, 1e-14);
  }
}

TEST(Wilson, IsUndefinedWithoutTrials) {
  EXPECT_TRUE(std::isnan(wilson_interval(0, 0).lower));
  EXPECT_TRUE(std::isnan(wilson_interval(0, 0).upper));
}

}  // namespace
}  // namespace sturz
