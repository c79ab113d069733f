// SPDX-License-Identifier: Apache-2.0
#include "ensemble/stopping/arrival_counts.hpp"

#include "ensemble/hazard/wilson.hpp"
#include "tests/support/memory_members.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace sturz {
namespace {

using test::MemoryMembers;
using test::random_member;
using test::small_grid;

/// Members of one row of cells: cell c is reached by the first hits[c] of n members.
ArrivalCounts counts_of(const std::vector<int>& hits, int n, int col0 = 0) {
  ArrivalCounts counts;
  for (int m = 0; m < n; ++m) {
    std::vector<float> arrival;
    for (const int h : hits) arrival.push_back(m < h ? 1.0F : nan_f);
    counts.add({0, col0, 1, static_cast<int>(hits.size())}, arrival);
  }
  return counts;
}

TEST(ArrivalCounts, FindsTheLeastSureOfTheUncertainCells) {
  // n = 4, k = 2: z / (n + z^2) sqrt(k (n - k) / n + z^2 / 4) = 0.34996; k = 3: 0.32689.
  const LargestHalfWidth found = counts_of({4, 3, 2, 0}, 4).largest_half_width();
  EXPECT_EQ(found.at, LookedAt::uncertain_cells);
  EXPECT_EQ(found.n_cells, 2);
  EXPECT_EQ(found.n_valid, 4);
  EXPECT_NEAR(found.half_width, 0.3499610, 1e-7);
}

TEST(ArrivalCounts, ItsLimitsBelongToTheSureCells) {
  // 1 and 19 of 20 are 0.05 and 0.95 themselves.
  const LargestHalfWidth at_limits = counts_of({1, 19, 20}, 20).largest_half_width();
  EXPECT_EQ(at_limits.at, LookedAt::reached_cells);
  EXPECT_EQ(at_limits.n_cells, 3);
  EXPECT_NEAR(at_limits.half_width, 0.1136249, 1e-7);
  const LargestHalfWidth inside = counts_of({2, 20}, 20).largest_half_width();
  EXPECT_EQ(inside.at, LookedAt::uncertain_cells);
  EXPECT_EQ(inside.n_cells, 1);
  EXPECT_NEAR(inside.half_width, 0.1365836, 1e-7);
}

TEST(ArrivalCounts, WithoutAReachedCellItIsThatOfAProbabilityOfZero) {
  // z^2 / (n + z^2) / 2
  const LargestHalfWidth found = counts_of({0, 0}, 32).largest_half_width();
  EXPECT_EQ(found.at, LookedAt::no_cell);
  EXPECT_EQ(found.n_cells, 0);
  EXPECT_NEAR(found.half_width, 0.0535896, 1e-7);
  ArrivalCounts still;
  for (int m = 0; m < 32; ++m) still.add(Window{}, {});
  EXPECT_EQ(still.largest_half_width().half_width, found.half_width);
}

TEST(ArrivalCounts, WithoutMembersNothingIsKnown) {
  EXPECT_TRUE(std::isnan(ArrivalCounts().largest_half_width().half_width));
  ArrivalCounts counts;
  MemberResult failed;
  failed.outcome = Outcome::failed;
  counts.add(failed);
  EXPECT_EQ(counts.n_valid(), 0);
}

TEST(ArrivalCounts, IsTheSameForEveryOrderAndEqualsCellByCell) {
  const Grid grid = small_grid(150, 140);  // several tiles
  std::mt19937 random(5);
  std::vector<MemberResult> members;
  for (int m = 0; m < 23; ++m) members.push_back(random_member(m, grid, random));
  members[7].outcome = Outcome::diverged;
  ArrivalCounts counts;
  for (const MemberResult& m : members) counts.add(m);
  LargestHalfWidth expected;
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col) {
      const auto hits = std::count_if(members.begin(), members.end(), [&](const MemberResult& m) {
        return is_valid(m.outcome) &&
               !std::isnan(MemoryMembers::value(m, PeakLayer::arrival, row, col));
      });
      const double p = static_cast<double>(hits) / 22;
      if (!(p > 0.05 && p < 0.95)) continue;
      const ProbabilityBounds bounds = wilson_interval(hits, 22);
      expected.half_width = std::max(expected.half_width, (bounds.upper - bounds.lower) / 2);
      ++expected.n_cells;
    }
  const LargestHalfWidth found = counts.largest_half_width();
  EXPECT_EQ(found.n_valid, 22);
  EXPECT_GT(expected.n_cells, 100);
  EXPECT_EQ(found.n_cells, expected.n_cells);
  EXPECT_EQ(found.half_width, expected.half_width);
  std::shuffle(members.begin(), members.end(), random);
  ArrivalCounts again;
  for (const MemberResult& m : members) again.add(m);
  EXPECT_EQ(again.largest_half_width().half_width, found.half_width);
  EXPECT_EQ(again.largest_half_width().n_cells, found.n_cells);
}

TEST(ArrivalCounts, PlacesBehindTheFirstTileAreTheirOwn) {
  ArrivalCounts counts = counts_of({2, 2}, 2, 63);  // columns 63 and 64: two tiles
  counts.add({0, 64, 1, 1}, std::vector<float>{nan_f});
  counts.add({0, 127, 1, 1}, std::vector<float>{0.0F});
  const LargestHalfWidth found = counts.largest_half_width();
  EXPECT_EQ(found.n_cells, 3);  // two with 2 of 4, one with 1 of 4
  EXPECT_NEAR(found.half_width, 0.3499610, 1e-7);
}

}  // namespace
}  // namespace sturz
