// SPDX-License-Identifier: Apache-2.0
#include "ensemble/stopping/stop_rule.hpp"

#include "ensemble/hazard/wilson.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <limits>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

StopRecord record_of(double wanted, std::int64_t members, double half_width) {
  StopRecord record;
  record.wanted_half_width = wanted;
  record.at_most = 4000;
  record.n_looks = 3;
  record.last = {members, {half_width, LookedAt::uncertain_cells, 214, members}};
  return record;
}

TEST(StopRule, LooksAtFixedCounts) {
  EXPECT_THAT(look_counts(200), ElementsAre(32, 64, 96, 128, 160, 192, 200));
  EXPECT_THAT(look_counts(192), ElementsAre(32, 64, 96, 128, 160, 192));
  EXPECT_THAT(look_counts(20), ElementsAre(20));
  EXPECT_THAT(look_counts(1), ElementsAre(1));
}

TEST(StopRule, LooksEightTimesUntilTheNumberDoubles) {
  const auto looks = look_counts(2400);
  ASSERT_EQ(looks.size(), 34u);
  EXPECT_EQ(looks[15], 512);
  EXPECT_EQ(looks[16], 576);
  EXPECT_EQ(looks[24], 1152);
  EXPECT_EQ(looks[32], 2304);
  EXPECT_EQ(looks.back(), 2400);
}

TEST(StopRule, AHigherCapHasTheSameLooksBeforeIt) {
  const auto shorter = look_counts(700), longer = look_counts(3000);
  for (std::size_t i = 0; i + 1 < shorter.size(); ++i) EXPECT_EQ(shorter[i], longer[i]);
}

TEST(StopRule, TheLeastSureProbabilityIsCertainFromSoManyMembersOn) {
  EXPECT_EQ(certain_count(0.02), 2398);  // 0.25 (1.96 / 0.02)^2 - 1.96^2 = 2397.07
  EXPECT_EQ(certain_count(0.05), 381);
  EXPECT_EQ(certain_count(0.1), 93);
  EXPECT_EQ(certain_count(0.5), 1);
  const ProbabilityBounds enough = wilson_interval(1199, 2398), few = wilson_interval(1198, 2396);
  EXPECT_LE((enough.upper - enough.lower) / 2, 0.02);
  EXPECT_GT((few.upper - few.lower) / 2, 0.02);
}

TEST(StopRule, ExpectsHalfWidthsToFallWithTheRoot) {
  const auto looks = look_counts(4000);
  EXPECT_EQ(expected_count(record_of(0.05, 64, 0.1), looks), 256);   // four times as many
  EXPECT_EQ(expected_count(record_of(0.05, 64, 0.11), looks), 320);  // 309.8
  EXPECT_EQ(expected_count(record_of(0.05, 64, 0.04), looks), 64);
  EXPECT_EQ(expected_count(record_of(0.001, 64, 0.1), looks), 4000);
  StopRecord before;
  before.wanted_half_width = 0.1;
  EXPECT_EQ(expected_count(before, looks), 96);  // 93 are certain
}

TEST(StopRule, IsReachedAtTheWantedHalfWidthAndNotWithoutMembers) {
  EXPECT_TRUE(record_of(0.1, 96, 0.1).reached());
  EXPECT_FALSE(record_of(0.1, 96, 0.1001).reached());
  EXPECT_FALSE(record_of(0.1, 96, std::numeric_limits<double>::quiet_NaN()).reached());
}

TEST(StopRule, SaysWhatWasLookedAt) {
  StopRecord record = record_of(0.1, 96, 0.09872);
  EXPECT_EQ(stop_text(record),
            "the largest half width of P(reached) is 0.0987, wanted is 0.1, in 214 cells with 0.05 "
            "< P < 0.95; 96 members, 96 of them valid; look 3; 4000 members at most");
  record.last.found.at = LookedAt::reached_cells;
  EXPECT_THAT(stop_text(record), HasSubstr("all 214 reached cells, because none has 0.05 < P"));
  record.last.found.at = LookedAt::no_cell;
  EXPECT_THAT(stop_text(record), HasSubstr("because no member reached one"));
  record.last.found.at = LookedAt::asset;
  record.last.found.n_not_known = 2;
  record.asset = "house";
  EXPECT_EQ(stop_text(record),
            "the half width of P(hit) of house is 0.0987, wanted is 0.1; 96 members, 96 of them "
            "valid, 2 cut off before they hit it; look 3; 4000 members at most");
}

}  // namespace
}  // namespace sturz
