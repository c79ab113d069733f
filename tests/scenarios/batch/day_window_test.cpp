// SPDX-License-Identifier: Apache-2.0
#include "scenarios/batch/day_window.hpp"

#include <gtest/gtest.h>

namespace sturz {
namespace {

constexpr int at(int hour, int minute) { return 60 * hour + minute; }

TEST(DayWindow, IsReadAndWritten) {
  const auto w = parse_day_window("20:00-06:30");
  ASSERT_TRUE(w);
  EXPECT_EQ(w->from_min, at(20, 0));
  EXPECT_EQ(w->to_min, at(6, 30));
  EXPECT_EQ(day_window_text(*w), "20:00-06:30");
}

TEST(DayWindow, OtherTextsAreRefused) {
  for (const char* text : {"", "20:00", "20-06", "24:00-06:00", "20:60-06:00", "20:00-20:00",
                           "20:00 - 06:00", "8:00-06:00", "20:00-06:00x", "aa:bb-cc:dd"})
    EXPECT_FALSE(parse_day_window(text)) << text;
}

TEST(DayWindow, MayGoOverMidnight) {
  const DayWindow night{at(20, 0), at(6, 0)}, day{at(9, 0), at(17, 0)};
  EXPECT_TRUE(is_open(night, at(20, 0)));
  EXPECT_TRUE(is_open(night, at(23, 59)));
  EXPECT_TRUE(is_open(night, at(0, 0)));
  EXPECT_TRUE(is_open(night, at(5, 59)));
  EXPECT_FALSE(is_open(night, at(6, 0)));
  EXPECT_FALSE(is_open(night, at(12, 0)));
  EXPECT_TRUE(is_open(day, at(9, 0)));
  EXPECT_FALSE(is_open(day, at(17, 0)));
  EXPECT_FALSE(is_open(day, at(3, 0)));
}

TEST(DayWindow, TellsHowLongUntilItOpens) {
  const DayWindow night{at(20, 0), at(6, 0)}, day{at(9, 0), at(17, 0)};
  EXPECT_EQ(minutes_until_open(night, at(21, 0)), 0);
  EXPECT_EQ(minutes_until_open(night, at(6, 0)), 14 * 60);
  EXPECT_EQ(minutes_until_open(day, at(18, 0)), 15 * 60);
  EXPECT_EQ(minutes_until_open(day, at(8, 59)), 1);
}

}  // namespace
}  // namespace sturz
