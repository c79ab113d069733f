// SPDX-License-Identifier: Apache-2.0
#include "ensemble/comparison/paired_difference.hpp"

#include "ensemble/hazard/wilson.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sturz {
namespace {

TEST(PairedDifference, MatchesPublishedIntervals) {
  // Airway hyper-responsiveness before and after stem cell transplantation (Bentur et al. 2009), as
  // Fagerland, Lydersen and Laake (2014, Stat. Med. 33, 2850-2875) give it: difference of the first
  // share less the second -0.286, -0.507 to -0.026. Here the second less the first.
  const DifferenceBounds d = paired_difference({1, 1, 7, 12});
  EXPECT_NEAR(d.difference, 0.286, 5e-4);
  EXPECT_NEAR(d.lower, 0.026, 5e-4);
  EXPECT_NEAR(d.upper, 0.507, 5e-4);
}

TEST(PairedDifference, WithoutDiscordantPairsIsTheWilsonIntervalOfBoth) {
  // Both shares are 1: each interval ends 1 - n / (n + z^2) below.
  const DifferenceBounds d = paired_difference({54, 0, 0, 0});
  EXPECT_EQ(d.difference, 0);
  EXPECT_NEAR(d.lower, -(1 - 54 / (54 + z_95 * z_95)), 1e-12);
  EXPECT_NEAR(d.upper, -d.lower, 1e-12);
}

TEST(PairedDifference, TurnsItsSignWithItsSides) {
  for (const PairCounts c :
       {PairCounts{20, 12, 2, 16}, {3, 0, 9, 1}, {0, 4, 5, 30}, {36, 12, 2, 0}}) {
    const DifferenceBounds d = paired_difference(c);
    const DifferenceBounds turned = paired_difference({c.both, c.only_b, c.only_a, c.neither});
    EXPECT_NEAR(d.difference, -turned.difference, 1e-14);
    EXPECT_NEAR(d.lower, -turned.upper, 1e-14);
    EXPECT_NEAR(d.upper, -turned.lower, 1e-14);
    EXPECT_LE(d.lower, d.difference);
    EXPECT_GE(d.upper, d.difference);
  }
}

TEST(PairedDifference, OfLargeSamplesIsThatOfTheNormalDistribution) {
  // McNemar's variance: (b + c - (b - c)^2 / n) / n^2.
  const PairCounts c{40000, 3000, 5000, 52000};
  const double n = 100000;
  const double error = std::sqrt(8000 - 2000.0 * 2000 / n) / n;
  const DifferenceBounds d = paired_difference(c);
  EXPECT_NEAR(d.difference, 0.02, 1e-12);
  EXPECT_NEAR(d.lower, 0.02 - z_95 * error, 2e-2 * error);
  EXPECT_NEAR(d.upper, 0.02 + z_95 * error, 2e-2 * error);
}

TEST(PairedDifference, HoldsItsConfidence) {
  std::mt19937 random(11);
  std::discrete_distribution<int> pair({0.35, 0.15, 0.05, 0.45});
  int inside = 0;
  constexpr int trials = 2000;
  for (int t = 0; t < trials; ++t) {
    std::int64_t n[4] = {0, 0, 0, 0};
    for (int k = 0; k < 64; ++k) ++n[pair(random)];
    const DifferenceBounds d = paired_difference({n[0], n[1], n[2], n[3]});
    inside += d.lower <= -0.1 && -0.1 <= d.upper;
  }
  EXPECT_GT(inside, 0.93 * trials);
  EXPECT_LT(inside, 0.985 * trials);
}

TEST(UnpairedDifference, MatchesPublishedIntervals) {
  // 56/70 less 48/80: 0.0524 to 0.3339 (Newcombe 1998, Stat. Med. 17, 873-890, table II, method
  // 10).
  const DifferenceBounds d = unpaired_difference(48, 80, 56, 70);
  EXPECT_NEAR(d.difference, 0.2, 1e-12);
  EXPECT_NEAR(d.lower, 0.0524, 5e-5);
  EXPECT_NEAR(d.upper, 0.3339, 5e-5);
}

TEST(UnpairedDifference, IsWiderThanThatOfPairsThatGoTogether) {
  const PairCounts c{30, 2, 8, 24};
  const double own = paired_difference(c).width();
  const double heaps = unpaired_difference(c.a(), c.n(), c.b(), c.n()).width();
  EXPECT_GT(heaps / own, 1.4);
}

TEST(UnpairedDifference, IsUnknownWithoutMembers) {
  EXPECT_TRUE(std::isnan(unpaired_difference(0, 0, 3, 5).lower));
  EXPECT_TRUE(std::isnan(paired_difference({}).upper));
}

}  // namespace
}  // namespace sturz
