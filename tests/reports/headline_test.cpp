// SPDX-License-Identifier: Apache-2.0
#include "reports/page/headline.hpp"

#include "reports/page/estimate_text.hpp"
#include "reports/page/text.hpp"
#include "tests/reports/made_up_results.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

TEST(ReportEstimate, IsWrittenAsFarAsItIsKnown) {
  const NumberWriter metres = [](double v) { return shown_number(v) + " m"; };
  CensoredEstimate e;
  e.n = 40, e.value = 2440, e.lower = 2435, e.upper = 2446;
  EXPECT_EQ(value_text(e, metres), "2440 m");
  EXPECT_EQ(interval_text(e, metres), "95\u00A0% interval 2435 m \u2013 2446 m");
  EXPECT_EQ(cut_text(e), "");
  e.at_least = true, e.upper = INFINITY, e.n_at_least = 36;
  EXPECT_EQ(value_text(e, metres), "\u2265\u00A02440 m");
  EXPECT_EQ(interval_text(e, metres), "95\u00A0% interval from 2435 m, upper end not known");
  EXPECT_EQ(cut_text(e), "36 of 40 cut off");
  e.value = nan_d, e.lower = -INFINITY;
  EXPECT_EQ(value_text(e, metres), "not known");
  EXPECT_EQ(interval_text(e, metres), "no interval: too many are cut off");
  e.least = 2400, e.most = 2471.4;
  EXPECT_EQ(value_text(e, metres), "2400 m to 2471 m");
  e.most = 2400.04;
  EXPECT_EQ(value_text(e, metres), "2400 m");
  e.least = e.most = nan_d;
  e.lower = e.upper = nan_d;
  EXPECT_EQ(interval_text(e, metres), "too few simulations for an interval");
  EXPECT_EQ(value_text({}, metres), "\u2013");
}

TEST(ReportHeadline, MedianOfMembersThatLeftIsALowerBound) {
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  for (MemberSummary& m : input.members) m.censoring = Censoring::none;
  const double median = headline(input).runout_m.value;
  for (MemberSummary& m : input.members)
    if (m.scalars.runout_m > 0.9 * median) {
      m.scalars.runout_m = 0.9 * median;  // the edge
      m.censoring = Censoring::left_terrain;
    }
  const Headline cut = headline(input);
  EXPECT_TRUE(cut.runout_m.at_least);
  EXPECT_LE(cut.runout_m.lower, median);
  EXPECT_TRUE(std::isinf(cut.runout_m.upper));
  EXPECT_TRUE(cut.censoring.too_many());
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

TEST(ReportHeadline, WeightedAreaHasAnIntervalOfItsEffectiveMembers) {
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  const Estimate alike = headline(input).likely_area_m2;
  input.weights.assign(31, 1.0 / 31);
  input.effective_members = 10;
  const Estimate few = headline(input).likely_area_m2;
  EXPECT_DOUBLE_EQ(few.value, alike.value);
  EXPECT_LT(few.lower, few.value);
  EXPECT_GT(few.upper, few.value);
  input.effective_members = 1000;
  const Estimate many = headline(input).likely_area_m2;
  EXPECT_GE(many.lower, few.lower);
  EXPECT_LE(many.upper, few.upper);
}

}  // namespace
}  // namespace sturz
