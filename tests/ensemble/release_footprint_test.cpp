// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/release_footprint.hpp"

#include "tests/support/memory_members.hpp"

#include <gtest/gtest.h>

namespace sturz {
namespace {

/// Covers `cells` of the grid at once and the cell (5, 6) later.
MemberResult member(std::int64_t number, const Grid& grid,
                    std::initializer_list<std::pair<int, int>> cells) {
  MemberResult r;
  r.member = number;
  r.outcome = Outcome::settled;
  r.grid = grid;
  r.window = {1, 2, 5, 5};  // rows 1 to 5, columns 2 to 6
  for (int k = 0; k < n_peak_layers; ++k)
    r.layers[k].assign(r.window.n_cells(), info(static_cast<PeakLayer>(k)).untouched);
  const auto at = [&](int row, int col) -> float& {
    return r.layer(PeakLayer::arrival)[static_cast<std::size_t>(row - 1) * 5 + (col - 2)];
  };
  for (const auto& [row, col] : cells) at(row, col) = 0;
  at(5, 6) = 12.5F;
  return r;
}

TEST(ReleaseFootprint, JoinsWhatMembersCoverAtOnce) {
  const Grid grid = test::small_grid(8, 9);
  test::MemoryMembers source(grid);
  MemberResult failed = member(0, grid, {{1, 2}});
  failed.outcome = Outcome::diverged;
  source.add(failed);
  source.add(member(1, grid, {{2, 3}, {2, 4}}));
  source.add(member(2, grid, {{3, 4}}));
  const Raster<std::uint8_t> covered = release_footprint(source);
  ASSERT_EQ(covered.grid.n_rows, 2);
  ASSERT_EQ(covered.grid.n_cols, 2);
  EXPECT_EQ(covered.grid.west_m, grid.west_m + 3 * grid.cell_m);
  EXPECT_EQ(covered.grid.north_m, grid.north_m - 2 * grid.cell_m);
  EXPECT_EQ(covered.values, (std::vector<std::uint8_t>{1, 1, 0, 1}));
  EXPECT_EQ(release_footprint(source, 1).grid.n_rows, 1) << "the first valid one alone";
}

TEST(ReleaseFootprint, IsEmptyWithoutMembers) {
  EXPECT_EQ(release_footprint(test::MemoryMembers(test::small_grid(3, 3))).grid.n_cells(), 0U);
}

}  // namespace
}  // namespace sturz
