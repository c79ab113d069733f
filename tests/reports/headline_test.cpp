// SPDX-License-Identifier: Apache-2.0
#include "reports/page/headline.hpp"

#include "tests/reports/made_up_results.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace sturz {
namespace {

std::vector<double> up_to(int n) {
  std::vector<double> values(static_cast<std::size_t>(n));
  std::iota(values.begin(), values.end(), 1);
  return values;
}

TEST(ReportMedian, HasTheTabulatedOrderStatistics) {
  // Ranks of the 95 % interval of a median, e.g. Conover, Practical Nonparametric Statistics:
  // n = 10: 2 and 9; n = 20: 6 and 15; n = 50: 18 and 33.
  for (const auto& [n, low, high] : {std::tuple{10, 2, 9}, {20, 6, 15}, {50, 18, 33}}) {
    const Estimate e = median_estimate(up_to(n));
    EXPECT_EQ(e.lower, low) << n;
    EXPECT_EQ(e.upper, high) << n;
    EXPECT_EQ(e.value, (n + 1) / 2.0);
  }
}

TEST(ReportMedian, TellsNoIntervalFromTooFewMembers) {
  const Estimate five = median_estimate(up_to(5));
  EXPECT_EQ(five.value, 3);
  EXPECT_TRUE(std::isnan(five.lower));
  const Estimate six = median_estimate(up_to(6));
  EXPECT_EQ(six.lower, 1);
  EXPECT_EQ(six.upper, 6);
  EXPECT_TRUE(std::isnan(median_estimate({}).value));
}

TEST(ReportMedian, StaysFiniteForLargeSamples) {
  const Estimate e = median_estimate(up_to(20001));
  EXPECT_EQ(e.value, 10001);
  EXPECT_NEAR(e.lower, 10001 - 1.96 * std::sqrt(20001) / 2, 2);
}

TEST(ReportHeadline, CountsOnlyValidMembers) {
  const auto results = testing::make_up_results();
  const ReportInput input = results.ensemble_input();
  const Headline h = headline(input);
  EXPECT_EQ(h.n_members, 32);
  EXPECT_EQ(h.n_valid, 31);
  int counted = 0;
  for (const auto& [outcome, n] : h.outcomes) counted += n;
  EXPECT_EQ(counted, 32);
  EXPECT_GT(h.likely_area_m2.lower, 0);
  EXPECT_LE(h.likely_area_m2.lower, h.likely_area_m2.value);
  EXPECT_GE(h.likely_area_m2.upper, h.likely_area_m2.value);
  EXPECT_LT(h.runout_m.lower, h.runout_m.value);
  EXPECT_NEAR(h.members_per_hour, 32 * 3600 / input.elapsed_s, 1e-9);
}

TEST(ReportHeadline, LikelyAreaIsTheCellsWithAtLeastOneHalf) {
  const auto results = testing::make_up_results();
  const Headline h = headline(results.ensemble_input());
  const Layer* reached = results.hazard.find("probability_of_reach");
  ASSERT_NE(reached, nullptr);
  double area = 0;
  for (const float p : reached->values) area += p >= 0.5F ? 20 * 20 : 0;
  EXPECT_DOUBLE_EQ(h.likely_area_m2.value, area);
}

}  // namespace
}  // namespace sturz
