// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/contingency.hpp"

#include "tests/support/memory_members.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

TEST(Contingency, ScoresOfATableWrittenByHand) {
  const Contingency t{30, 10, 20, 40};
  EXPECT_DOUBLE_EQ(intersection_over_union(t), 0.5);
  EXPECT_DOUBLE_EQ(hit_rate(t), 0.6);
  EXPECT_DOUBLE_EQ(false_alarm_ratio(t), 0.25);
  // Both products are doubled: 2 (30 40 - 10 20) / (50 60 + 40 50). Doubling only the first, as is
  // found in the field, would give 0.44.
  EXPECT_DOUBLE_EQ(heidke_skill(t), 0.4);
}

TEST(Contingency, SkillIsOneForAPerfectTableAndNoneForChance) {
  EXPECT_DOUBLE_EQ(heidke_skill({25, 0, 0, 75}), 1);
  EXPECT_DOUBLE_EQ(heidke_skill({6, 14, 24, 56}), 0);  // rows and columns independent: 0.2 x 0.3
  EXPECT_DOUBLE_EQ(heidke_skill({0, 50, 50, 0}), -1);
  EXPECT_DOUBLE_EQ(intersection_over_union({25, 0, 0, 75}), 1);
}

TEST(Contingency, WhatHasNoDenominatorIsNotANumber) {
  EXPECT_TRUE(std::isnan(intersection_over_union({0, 0, 0, 10})));
  EXPECT_TRUE(std::isnan(false_alarm_ratio({0, 0, 5, 10})));
  EXPECT_TRUE(std::isnan(hit_rate({0, 5, 0, 10})));
  EXPECT_TRUE(std::isnan(heidke_skill({0, 0, 0, 10})));
  EXPECT_EQ(hit_rate({0, 0, 5, 10}), 0);
}

/// Cells of the maps that are set, on the raster of a window.
Raster<std::uint8_t> cells_of(const Window& w, const Grid& maps,
                              const std::vector<std::pair<int, int>>& set) {
  Raster<std::uint8_t> cells(grid_of(w, maps), 0);
  for (const auto& [row, col] : set) cells.at(row - w.row0, col - w.col0) = 1;
  return cells;
}

TEST(Contingency, CellsOfTheOutlineCountWithTheirShare) {
  const Grid maps = test::small_grid(20, 20, 10);
  Raster<double> cover(grid_of({5, 5, 2, 4}, maps), 0.0);
  // Two rows of four: the last column is half covered.
  for (int row = 0; row < 2; ++row) {
    for (int col = 0; col < 3; ++col) cover.at(row, col) = 1;
    cover.at(row, 3) = 0.5;
  }
  const ObservedCells observed(cover, maps);
  EXPECT_EQ(observed.domain(), (Window{3, 3, 6, 8}));  // half of four cells on every side
  // The upper row, the half cell of the lower one, and one cell far outside the domain.
  const auto simulated =
      cells_of({0, 0, 20, 20}, maps, {{5, 5}, {5, 6}, {5, 7}, {5, 8}, {6, 8}, {19, 19}});
  const Contingency t = observed.against(simulated);
  EXPECT_DOUBLE_EQ(t.hit_m2, 100 * (3 + 0.5 + 0.5));
  EXPECT_DOUBLE_EQ(t.false_m2, 100 * (0.5 + 0.5 + 1));
  EXPECT_DOUBLE_EQ(t.missed_m2, 100 * 3);
  EXPECT_DOUBLE_EQ(t.neither_m2, 100 * (48 - 7 - 1));  // the far cell is none of the domain's
  // Nothing depends on the window that the member came in, nor on where it ends.
  const Contingency other = observed.against(
      cells_of({5, 5, 15, 15}, maps, {{5, 5}, {5, 6}, {5, 7}, {5, 8}, {6, 8}, {19, 19}}));
  EXPECT_EQ(other.hit_m2, t.hit_m2);
  EXPECT_EQ(other.neither_m2, t.neither_m2);
}

TEST(Contingency, AMemberThatCoversNothingMissesAll) {
  const Grid maps = test::small_grid(10, 10, 2);
  const Raster<double> cover(grid_of({4, 4, 3, 3}, maps), 1.0);
  const ObservedCells observed(cover, maps);
  const Contingency t = observed.against(Raster<std::uint8_t>());
  EXPECT_DOUBLE_EQ(t.missed_m2, 4 * 9);
  EXPECT_EQ(t.hit_m2, 0);
  EXPECT_EQ(intersection_over_union(t), 0);
}

}  // namespace
}  // namespace sturz
