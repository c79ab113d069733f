// SPDX-License-Identifier: Apache-2.0
#include "io/site/polygon_cells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Ring = std::vector<Vec2>;

std::vector<std::size_t> cells_of(const Grid& grid, const std::vector<Ring>& rings) {
  PolygonCells cells(grid);
  for (const Ring& ring : rings) cells.add_ring(ring);
  return cells.finish();
}

Ring box(double west, double south, double east, double north) {
  return {{west, south}, {east, south}, {east, north}, {west, north}, {west, south}};
}

/// 4 x 4 cells of 1 m with the north-west corner at 0, 4.
const Grid small{4, 4, 0, 4, 1, ""};

TEST(PolygonCells, ACellBelongsWhereItsCentreLies) {
  EXPECT_THAT(cells_of(small, {box(0.4, 1.6, 2.4, 3.6)}), ElementsAre(0, 1, 4, 5));
  EXPECT_THAT(cells_of(small, {box(0.6, 1.6, 1.4, 3.4)}), IsEmpty());
  EXPECT_THAT(cells_of(small, {{{0, 0}, {4, 0}, {0, 3.9}}}), ElementsAre(4, 8, 9, 12, 13, 14));
}

TEST(PolygonCells, HolesAreLeftOutInAnyOrientation) {
  Ring hole = box(1, 1, 3, 3);
  const auto edge = ElementsAre(0, 1, 2, 3, 4, 7, 8, 11, 12, 13, 14, 15);
  EXPECT_THAT(cells_of(small, {box(0, 0, 4, 4), hole}), edge);
  std::reverse(hole.begin(), hole.end());
  EXPECT_THAT(cells_of(small, {box(0, 0, 4, 4), hole}), edge);
}

TEST(PolygonCells, WhatLiesOutsideIsLeftOut) {
  EXPECT_EQ(cells_of(small, {box(-1e9, -1e9, 1e9, 1e9)}).size(), 16U);
  EXPECT_THAT(cells_of(small, {box(-50, 3, 1, 90)}), ElementsAre(0));
  EXPECT_THAT(cells_of(small, {box(5, 0, 9, 4)}), IsEmpty());
  EXPECT_THAT(cells_of(small, {box(0, 5, 4, 9)}), IsEmpty());
  EXPECT_THAT(cells_of(small, {}), IsEmpty());
}

/// Corners of a star around the middle of a grid at map coordinates.
Ring star(std::mt19937& random) {
  std::uniform_real_distribution<> radius(0.1, 1);
  Ring corners;
  for (int i = 0; i < 37; ++i) {
    const double angle = 2 * std::numbers::pi * i / 37, r = 60 * radius(random);
    corners.emplace_back(1000050 + r * std::cos(angle), 5000050 + r * std::sin(angle));
  }
  return corners;
}

bool holds(const Ring& ring, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.y() > y) != (b.y() > y) && x < a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

TEST(PolygonCells, AgreeWithATestOfEveryPoint) {
  std::mt19937 random(5);
  const Grid grid{33, 33, 1000000.5, 5000099.5, 3, ""};
  for (int trial = 0; trial < 50; ++trial) {
    const Ring ring = star(random);
    std::vector<std::size_t> expected;
    for (int row = 0; row < grid.n_rows; ++row)
      for (int col = 0; col < grid.n_cols; ++col)
        if (holds(ring, grid.x_center(col), grid.y_center(row)))
          expected.push_back(grid.index(row, col));
    EXPECT_EQ(cells_of(grid, {ring}), expected);
  }
}

TEST(PolygonCells, NeighboursShareNoCellAndLeaveNone) {
  // Edges run exactly through centres, and each is walked in both directions.
  const Grid grid{40, 40, 0, 40, 1, ""};
  std::vector<int> owners(grid.n_cells(), 0);
  const std::vector<Vec2> edge = {{0, 0},   {20, 0},  {40, 0}, {40, 20},
                                  {40, 40}, {20, 40}, {0, 40}, {0, 20}};
  const Vec2 middle(20.5, 19.5);
  for (std::size_t i = 0; i < edge.size(); ++i)
    for (const std::size_t cell : cells_of(grid, {{middle, edge[i], edge[(i + 1) % edge.size()]}}))
      ++owners[cell];
  EXPECT_EQ(std::count(owners.begin(), owners.end(), 1), 1600);
}

}  // namespace
}  // namespace sturz
