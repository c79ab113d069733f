// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/thickness_scores.hpp"

#include "ensemble/scores/path_distance.hpp"
#include "ensemble/scores/path_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sturz {
namespace {

TEST(ThicknessScores, OfACoupleOfCellsByHand) {
  const std::vector<ThicknessPair> cells = {
      {2, 3, 0},      // + 1
      {1, 0, 10},     // - 1
      {0, 2, 20},     // + 2: simulated where nothing was observed
      {0.05, 0, 30},  // neither is above 0.1
  };
  const ThicknessScores s = thickness_scores(cells, 0.1, 1);
  EXPECT_DOUBLE_EQ(s.rmse_m, std::sqrt(6.0 / 3));
  EXPECT_DOUBLE_EQ(s.bias_m, 2.0 / 3);
  EXPECT_DOUBLE_EQ(s.within, 2.0 / 3);
  EXPECT_DOUBLE_EQ(s.volume_ratio, 5 / 3.05);
  // Bands over 0 .. 10: the first holds 2 and 3, the last 1 and 0, beyond 0.05 and 2.
  EXPECT_DOUBLE_EQ(s.band_overlap, (2 + 0 + 0.05) / 5);
}

TEST(ThicknessScores, TheThresholdSaysWhichCellsCount) {
  const std::vector<ThicknessPair> cells = {{0.3, 0.1, 0}, {2, 1, 1}};
  EXPECT_DOUBLE_EQ(thickness_scores(cells, 0.1, 1).bias_m, (-0.2 - 1) / 2);
  EXPECT_DOUBLE_EQ(thickness_scores(cells, 0.5, 1).bias_m, -1);
  EXPECT_TRUE(std::isnan(thickness_scores(cells, 5, 1).rmse_m));
}

TEST(ThicknessScores, NetChangeCountsBothWays) {
  const std::vector<ThicknessPair> cells = {{-2, -1, 0}, {1, 1, 5}, {0, 0, 9}};
  const ThicknessScores s = thickness_scores(cells, 0.1, 0.5);
  EXPECT_DOUBLE_EQ(s.rmse_m, std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(s.within, 0.5);
}

TEST(ThicknessScores, ADepositInThePlaceOfTheObservedOverlapsWhole) {
  std::vector<ThicknessPair> cells;
  for (int i = 0; i < 100; ++i) cells.push_back({1.0 + i % 3, 1.0 + i % 3, double(i)});
  EXPECT_DOUBLE_EQ(thickness_scores(cells, 0.1, 1).band_overlap, 1);
  for (auto& p : cells) p.distance_m += 1000 * (p.observed_m > 0), p.simulated_m = 0;
  EXPECT_EQ(thickness_scores(cells, 0.1, 1).band_overlap, 0);
}

TEST(PathDistance, GoesRoundTheBendAndBeyondTheEnds) {
  // East for 100 m, then south for 50.
  const PathDistance path({{0, 0}, {100, 0}, {100, -50}}, {7, 7});
  EXPECT_TRUE(path.along_thalweg());
  EXPECT_DOUBLE_EQ(path.at({40, 12}), 40);
  EXPECT_DOUBLE_EQ(path.at({95, -30}), 130);
  EXPECT_DOUBLE_EQ(path.at({100, -80}), 180);  // beyond the end
  EXPECT_DOUBLE_EQ(path.at({-10, 3}), -10);    // before the start
  EXPECT_DOUBLE_EQ(path.at({120, 20}), 100);   // outside the bend
}

TEST(PathDistance, WithoutAThalwegIsStraightFromTheSource) {
  const PathDistance path({}, {10, 0});
  EXPECT_FALSE(path.along_thalweg());
  EXPECT_DOUBLE_EQ(path.at({13, 4}), 5);
  Grid maps;
  maps.n_cols = maps.n_rows = 10;
  const CellDistances some(path, maps, {0, 0, 2, 2}), none(path, maps, {});
  EXPECT_DOUBLE_EQ(some.at(0, 0), none.at(0, 0));
  EXPECT_DOUBLE_EQ(some.at(9, 9), path.at({maps.x_center(9), maps.y_center(9)}));
}

TEST(PathProfile, ComparesWidthsAndLargestValuesBandByBand) {
  PathProfile a(10), b(10);
  a.add(5, 100, 2);
  a.add(6, 100, 3);   // band 0: 20 m wide, 3 m
  a.add(15, 50, 1);   // band 1: 5 m wide
  b.add(2, 100, 1);   // band 0: 10 m wide
  b.add(25, 200, 4);  // band 2: 20 m wide
  EXPECT_DOUBLE_EQ(width_rmse_m(a, b), std::sqrt((100.0 + 25 + 400) / 3));
  EXPECT_DOUBLE_EQ(largest_rmse(a, b), std::sqrt((4.0 + 1 + 16) / 3));
  EXPECT_TRUE(std::isnan(width_rmse_m(PathProfile(10), PathProfile(10))));
  EXPECT_TRUE(std::isnan(a.runout_m()));
  a.reach(12), a.reach(40), a.reach(3);
  EXPECT_EQ(a.runout_m(), 40);
}

}  // namespace
}  // namespace sturz
