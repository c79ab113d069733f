// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/cell_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

Raster<std::uint8_t> cells(int n_rows, int n_cols, std::vector<std::uint8_t> values) {
  Raster<std::uint8_t> r(Grid{.n_cols = n_cols,
                              .n_rows = n_rows,
                              .west_m = 1000,
                              .north_m = 2000,
                              .cell_m = 10,
                              .crs_wkt = ""});
  r.values = std::move(values);
  return r;
}

TEST(CellOutline, GoesAroundAnLOfThreeCells) {
  const auto lines = cell_outline(cells(2, 2, {1, 0, 1, 1}));
  const std::vector<MapLine> wanted{{1000, 2000, 1010, 2000}, {1010, 1990, 1020, 1990},
                                    {1000, 1980, 1020, 1980}, {1000, 2000, 1000, 1980},
                                    {1010, 2000, 1010, 1990}, {1020, 1990, 1020, 1980}};
  EXPECT_EQ(lines.size(), wanted.size());
  for (const MapLine& line : wanted)
    EXPECT_NE(std::find(lines.begin(), lines.end(), line), lines.end())
        << line.x0 << ' ' << line.y0 << ' ' << line.x1 << ' ' << line.y1;
}

TEST(CellOutline, HasTheCircumferenceOfARectangleWithAHole) {
  const auto lines = cell_outline(cells(4, 5, {0, 0, 0, 0, 0,  //
                                               0, 1, 1, 1, 0,  //
                                               0, 1, 0, 1, 0,  //
                                               0, 1, 1, 1, 0}));
  double length = 0;
  for (const MapLine& l : lines) length += std::abs(l.x1 - l.x0) + std::abs(l.y1 - l.y0);
  EXPECT_EQ(lines.size(), 8U);
  EXPECT_DOUBLE_EQ(length, 120 + 40);
  EXPECT_TRUE(cell_outline(cells(1, 1, {0})).empty());
}

}  // namespace
}  // namespace sturz
