// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assets/damage_curve.hpp"

#include "scenarios/layers/feature_table.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace sturz {
namespace {

TEST(DamageCurve, IsLinearBetweenPointsAndEndsWithTheLast) {
  const DamageCurve curve{"timber", PeakLayer::pressure, {{1000, 0.2}, {3000, 1}}};
  EXPECT_EQ(damage_at(curve, 0), 0);
  EXPECT_EQ(damage_at(curve, 999.9), 0);  // a curve that begins above 0 begins with a step
  EXPECT_EQ(damage_at(curve, 1000), 0.2);
  EXPECT_DOUBLE_EQ(damage_at(curve, 2000), 0.6);
  EXPECT_DOUBLE_EQ(damage_at(curve, 2500), 0.8);
  EXPECT_EQ(damage_at(curve, 3000), 1);
  EXPECT_EQ(damage_at(curve, 1e9), 1);
}

TEST(DamageCurve, OfOnePointIsAStep) {
  const DamageCurve curve{"bridge", PeakLayer::thickness, {{2, 1}}};
  EXPECT_EQ(damage_at(curve, 1.99), 0);
  EXPECT_EQ(damage_at(curve, 2), 1);
}

TEST(FeatureTable, AsCsvQuotesTextAndLeavesUnknownNumbersOut) {
  FeatureTable table;
  table.wkb = {"", ""};
  table.columns = {
      {"name", std::vector<std::string>{"a, \"b\"", "c"}},
      {"hit_members", std::vector<std::int64_t>{3, 0}},
      {"speed_q50_m_s", std::vector<double>{0.1, std::numeric_limits<double>::quiet_NaN()}}};
  EXPECT_EQ(to_csv(table), "name,hit_members,speed_q50_m_s\n\"a, \"\"b\"\"\",3,0.1\nc,0,\n");
}

}  // namespace
}  // namespace sturz
