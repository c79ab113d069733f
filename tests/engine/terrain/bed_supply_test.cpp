// SPDX-License-Identifier: Apache-2.0
#include "engine/terrain/bed_supply.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace sturz {
namespace {

Grid ground(int n_rows, int n_cols, double cell_m = 5) {
  Grid g;
  g.n_rows = n_rows, g.n_cols = n_cols, g.cell_m = cell_m, g.west_m = 100, g.north_m = 900;
  return g;
}

TEST(BedSupply, IsTheSameEverywhereWithoutAPattern) {
  BedSupply bed(ground(40, 70), {2.5, nullptr, {}}, false, false);
  EXPECT_EQ(bed.cell(0, 0)->left, 2.5);
  EXPECT_EQ(bed.cell(39, 69)->left, 2.5);
  EXPECT_EQ(bed.cell(40, 0), nullptr);
  EXPECT_EQ(bed.cell(0, -1), nullptr);
}

TEST(BedSupply, FollowsThePatternAndEndsWithIt) {
  Raster<double> pattern(ground(2, 2), 1);
  pattern.at(0, 1) = 0.5, pattern.at(1, 1) = 0;
  const BedSource source{3, std::make_shared<const Raster<double>>(pattern), {10, 20, 2, 2}};
  BedSupply bed(ground(40, 70), source, false, false);
  EXPECT_EQ(bed.cell(10, 20)->left, 3);
  EXPECT_EQ(bed.cell(10, 21)->left, 1.5);
  EXPECT_EQ(bed.cell(11, 21)->left, 0);
  EXPECT_EQ(bed.cell(12, 20)->left, 0);
  BedSource endless = source;
  endless.depth_m = std::numeric_limits<double>::infinity();
  EXPECT_EQ(endless.depth(11, 21), 0) << "without bed nothing is endless";
  EXPECT_GT(endless.depth(10, 21), 1e300);
}

TEST(BedSupply, RepeatsWithTheGround) {
  BedSupply bed(ground(4, 6), {1, nullptr, {}}, true, false);
  EXPECT_EQ(bed.cell(1, -1), bed.cell(1, 5));
  EXPECT_EQ(bed.cell(1, 13), bed.cell(1, 1));
  EXPECT_EQ(bed.cell(-1, 0), nullptr) << "only along x";
}

TEST(BedSupply, CellsStayWhereTheyAre) {
  BedSupply bed(ground(400, 400), {1, nullptr, {}}, false, false);
  BedSupply::Cell* first = bed.cell(3, 4);
  first->eroded = 0.25;
  for (int k = 0; k < 400; ++k) bed.cell(k, k);
  EXPECT_EQ(bed.cell(3, 4), first);
  EXPECT_EQ(bed.cell(3, 4)->eroded, 0.25);
}

TEST(BedSupply, KeepsItsVolumeOnAnyGridOfMaps) {
  BedSupply bed(ground(40, 70), {9, nullptr, {}}, false, false);
  bed.cell(10, 20)->eroded = 1;
  bed.cell(11, 33)->eroded = 0.5;
  bed.cell(30, 60)->eroded = 2;
  EXPECT_DOUBLE_EQ(bed.eroded_volume_m3(), 25 * 3.5);
  for (const double cell : {5.0, 2.0, 7.0, 20.0}) {
    const Grid maps =
        ground(static_cast<int>(200 / cell) + 1, static_cast<int>(350 / cell) + 1, cell);
    const auto depth = eroded_depth_on(bed, maps, whole_of(maps));
    const double sum = std::accumulate(depth.begin(), depth.end(), 0.0);
    EXPECT_NEAR(sum * cell * cell, 25 * 3.5, 1e-4) << cell;
  }
  const Grid same = ground(40, 70);
  const auto part = eroded_depth_on(bed, same, {10, 20, 2, 14});
  ASSERT_EQ(part.size(), 28u);
  EXPECT_EQ(part[0], 1);
  EXPECT_EQ(part[14 + 13], 0.5F);
}

}  // namespace
}  // namespace sturz
