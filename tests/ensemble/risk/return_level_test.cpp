// SPDX-License-Identifier: Apache-2.0
// Rates and return levels of two scenarios by hand.
#include "ensemble/risk/return_level.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sturz {
namespace {

using ::testing::ElementsAre;

/// Once in 100 years, four members: each stands for 0.0025 events a year. Once in 1000 years, two
/// members: 0.0005 each.
const std::vector<ScenarioRate> two{{0.01, 4}, {0.001, 2}};

TEST(ReturnLevel, OfTwoScenariosByHand) {
  // Rates of being reached or exceeded: 5 -> 0.0005, 4 -> 0.001, 3 -> 0.0035, 2 -> 0.006,
  // 1 -> 0.0085. One member of the first did not come.
  std::vector<ScenarioPeak> peaks{{1, 0}, {5, 1}, {2, 0}, {3, 0}, {4, 1}};
  const std::vector<double> periods{30, 100, 120, 200, 300, 1000, 2000, 5000};
  EXPECT_THAT(return_levels(two, peaks, periods), ElementsAre(0, 0, 1, 2, 3, 4, 5, 5));
}

TEST(ReturnLevel, EqualPeaksCountTogether) {
  std::vector<ScenarioPeak> peaks{{2, 0}, {2, 0}, {2, 1}, {2, 1}};
  // 2 x 0.0025 + 0.001 = 0.006, once in 167 years.
  const std::vector<double> periods{160, 167};
  EXPECT_THAT(return_levels(two, peaks, periods), ElementsAre(0, 2));
}

TEST(ReturnLevel, IsZeroWhereNothingComes) {
  std::vector<ScenarioPeak> none;
  EXPECT_THAT(return_levels(two, none, std::vector<double>{1e6}), ElementsAre(0));
}

TEST(ReturnLevel, IsTheLargestValueWhoseRateIsLargeEnough) {
  std::mt19937 random(3);
  const std::vector<ScenarioRate> scenarios{{0.02, 7}, {0.003, 5}, {0.0007, 11}};
  const std::vector<double> periods{40, 90, 300, 1200, 9000};
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<ScenarioPeak> peaks;
    for (std::size_t s = 0; s < scenarios.size(); ++s)
      for (std::size_t m = 0; m < scenarios[s].n_members; ++m)
        if (random() % 4 != 0) peaks.push_back({static_cast<float>(random() % 9 + 1), s});
    auto shuffled = peaks;
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    const auto levels = return_levels(scenarios, peaks, periods);
    EXPECT_EQ(return_levels(scenarios, shuffled, periods), levels);
    for (std::size_t p = 0; p < periods.size(); ++p) {
      double expected = 0;
      for (double v = 1; v <= 9; ++v) {
        std::vector<std::size_t> hits(3, 0);
        for (const ScenarioPeak& peak : peaks) hits[peak.scenario] += peak.value >= v;
        if (annual_rate(scenarios, hits) >= 1 / periods[p]) expected = v;
      }
      EXPECT_EQ(levels[p], expected);
    }
  }
}

TEST(AnnualRate, AddsFrequenciesTimesShares) {
  const std::vector<std::size_t> hits{3, 2};
  EXPECT_DOUBLE_EQ(annual_rate(two, hits), 0.0085);
  // sqrt(0.01^2 x 0.75 x 0.25 / 4)
  EXPECT_NEAR(annual_rate_error(two, hits), 0.01 * std::sqrt(0.046875), 1e-15);
}

TEST(AnnualRate, OfRoundedSumsIsStillReached) {
  EXPECT_TRUE(reaches_rate(0.1 + 0.2, 0.3));
  EXPECT_TRUE(reaches_rate(0.3 - 1e-12, 0.3));
  EXPECT_FALSE(reaches_rate(0.2999, 0.3));
}

}  // namespace
}  // namespace sturz
