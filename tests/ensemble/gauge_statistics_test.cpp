// SPDX-License-Identifier: Apache-2.0
// What members saw at their gauges: never and not known are words, not numbers.
#include "ensemble/gauges/gauge_statistics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// One line over four instants; reached at `arrival` or, NaN, not at all.
GaugeResult seen(double arrival, double volume) {
  GaugeResult g;
  g.interval_s = 10;
  g.time_s = {0, 10, 20, 25};
  LineSeries line;
  line.name = "road, old";
  line.arrival_s = arrival;
  line.total_m3 = volume;
  line.volume_m3 = {0, 0, volume, volume};
  line.discharge_m3_s = {0, 0, volume / 10, 0};
  if (volume > 0) line.discharge = {volume / 10, 20};
  g.lines.push_back(line);
  return g;
}

const GaugeRow& row(const GaugeFindings& f, const std::string& quantity) {
  for (const GaugeRow& r : f.rows)
    if (r.quantity == quantity) return r;
  throw std::runtime_error(quantity);
}

TEST(GaugeStatistics, NeverIsAWord) {
  GaugeStatistics s;
  s.add(seen(12, 100), Censoring::none);
  s.add(seen(14, 50), Censoring::none);
  s.add(seen(std::nan(""), 0), Censoring::none);
  s.add(seen(std::nan(""), 0), Censoring::left_terrain);
  const GaugeFindings f = s.findings({0.25, 0.5, 0.95});
  EXPECT_THAT(row(f, "arrival").values, ElementsAre("12", "14", "never"));
  EXPECT_THAT(row(f, "volume").values, ElementsAre("not reached", "not reached", "100"));
  EXPECT_EQ(row(f, "arrival").reached, 2u);
  EXPECT_EQ(row(f, "arrival").unknown, 0u);
  EXPECT_THAT(gauges_csv(f), HasSubstr("gauge,quantity,units,members,reached,unknown,q25,q50,q95\n"
                                       "\"road, old\",arrival,s,4,2,0,12,14,never\n"));
}

TEST(GaugeStatistics, WhatWasCutOffIsNoNumberEither) {
  GaugeStatistics s;
  s.add(seen(12, 100), Censoring::none);
  s.add(seen(std::nan(""), 0), Censoring::still_moving);
  s.add(seen(13, 80), Censoring::still_moving);
  const GaugeFindings f = s.findings({0.3, 0.5, 0.9});
  EXPECT_THAT(row(f, "arrival").values, ElementsAre("12", "13", "> 25"));
  EXPECT_THAT(row(f, "volume").values, ElementsAre("not known", ">= 80", ">= 100"));
  EXPECT_EQ(row(f, "arrival").unknown, 1u);
  EXPECT_EQ(row(f, "volume").unknown, 2u);
}

TEST(GaugeStatistics, BandsCountWhoKnows) {
  GaugeStatistics s;
  GaugeResult longer = seen(12, 100);
  longer.time_s = {0, 10, 20, 30, 40};
  longer.lines[0].discharge_m3_s = {0, 1, 2, 3, 0};
  s.add(longer, Censoring::none);
  s.add(seen(14, 50), Censoring::none);
  s.add(seen(14, 70), Censoring::still_moving);
  const GaugeBand band = s.findings({0.5}).bands.at(0);
  EXPECT_THAT(band.time_s, ElementsAre(0, 10, 20, 30, 40));
  EXPECT_THAT(band.members, ElementsAre(3, 3, 3, 2, 2)) << "one was cut off after 25 s";
  EXPECT_THAT(band.values[0], ElementsAre(0, 0, 5, 0, 0));
}

TEST(GaugeStatistics, OneMemberHasValues) {
  GaugeStatistics s;
  s.add(seen(12, 100), Censoring::none);
  const GaugeFindings f = s.findings({0.5}, true);
  EXPECT_THAT(gauges_csv(f), HasSubstr("unknown,value\n"));
  EXPECT_THAT(gauge_series_csv(f), HasSubstr("\"road, old\",discharge,m3 s-1,20,1,10\n"));
  EXPECT_TRUE(GaugeStatistics().findings({0.5}).empty());
}

}  // namespace
}  // namespace sturz
