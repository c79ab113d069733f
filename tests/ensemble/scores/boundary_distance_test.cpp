// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/boundary_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sturz {
namespace {

std::vector<Vec2> square(double west, double south, double edge) {
  return {{west, south},
          {west + edge, south},
          {west + edge, south + edge},
          {west, south + edge},
          {west, south}};
}

SegmentIndex index_of(const std::vector<std::vector<Vec2>>& rings, double piece_m = 10) {
  return {sides_of(rings), piece_m};
}

/// Cells of 10 m whose south-west corner lies at 0, 0; text rows from the north.
Raster<std::uint8_t> drawn(const std::vector<std::string>& rows) {
  Grid grid;
  grid.n_rows = static_cast<int>(rows.size());
  grid.n_cols = static_cast<int>(rows.front().size());
  grid.cell_m = 10;
  grid.north_m = 10.0 * grid.n_rows;
  Raster<std::uint8_t> cells(grid, 0);
  for (int r = 0; r < grid.n_rows; ++r)
    for (int c = 0; c < grid.n_cols; ++c)
      cells.at(r, c) = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] == '#';
  return cells;
}

double total_length(const std::vector<Segment>& segments) {
  double sum = 0;
  for (const Segment& s : segments) sum += s.length();
  return sum;
}

TEST(OutlineSegments, TheBoundaryIsTheOuterOne) {
  EXPECT_DOUBLE_EQ(total_length(outer_boundary(drawn({"####", "#..#", "####"}))), 140);
  // An opening, even a diagonal one of a single corner, is none: cells hang together by their
  // sides.
  EXPECT_DOUBLE_EQ(total_length(outer_boundary(drawn({"####", "#..#", "##.#"}))), 140 + 60);
  EXPECT_EQ(without_holes(drawn({"####", "#..#", "####"})).at(1, 1), 1);
  EXPECT_EQ(without_holes(drawn({".##.", "#..#", "####"})).at(1, 1), 1);
  EXPECT_EQ(without_holes(drawn({"#.##", "#..#", "####"})).at(1, 1), 0);
  EXPECT_TRUE(outer_boundary(drawn({"..", ".."})).empty());
}

TEST(BoundaryDistance, EqualOutlinesLieOnEachOther) {
  const auto ring = square(0, 0, 100);
  const BoundaryDistance d = boundary_distance(index_of({ring}), index_of({ring}), 5, 1);
  EXPECT_NEAR(d.mean_m, 0, 1e-12);
  EXPECT_NEAR(d.hausdorff_m, 0, 1e-12);
  EXPECT_DOUBLE_EQ(d.within, 1);
}

TEST(BoundaryDistance, OfAShiftedSquareIsWorkedOutByHand) {
  // One square 20 m east of the other, edges of 100 m. Of each outline one long side lies 20 m off
  // (the west side of one, the east side of the other), one side 20 m inside the other square, and
  // the other two run along each other for 80 m and then 20 m beyond, on average 10 m off.
  const BoundaryDistance d =
      boundary_distance(index_of({square(0, 0, 100)}), index_of({square(20, 0, 100)}), 0.5, 5);
  // The inner sides are nearer to the long sides at their ends: 20 m in the middle, less at both.
  // Within 20 m of a corner the nearest place is above or below, at the distance to that corner.
  const double outer = 20 * 100, inner = 20 * (100 - 40) + 2 * (20 * 20 / 2.0);
  const double along = 2 * (20 * 20 / 2.0);
  EXPECT_NEAR(d.mean_m, (outer + inner + along) / 400, 0.01);
  EXPECT_NEAR(d.hausdorff_m, 20, 1e-9);
  // Within 5 m: 85 m of each long side, and 5 m at both ends of the inner side.
  EXPECT_NEAR(d.within, (2 * 85.0 + 2 * 5.0) / 400, 0.01);
}

TEST(BoundaryDistance, OneCellThrownAheadSetsTheLargest) {
  const auto compact = outer_boundary(drawn({"....................", "###.................",
                                             "....................", "...................."}));
  const auto thrown = outer_boundary(drawn({"....................", "###................#",
                                            "....................", "...................."}));
  const BoundaryDistance d =
      boundary_distance(SegmentIndex(compact, 20), SegmentIndex(thrown, 20), 2.5, 1);
  EXPECT_NEAR(d.hausdorff_m, 170, 1e-9);
  EXPECT_LT(d.mean_m, 50);
}

TEST(BoundaryDistance, NothingHasNoDistance) {
  const BoundaryDistance d = boundary_distance(index_of({}), index_of({square(0, 0, 1)}), 1, 1);
  EXPECT_TRUE(std::isnan(d.mean_m));
  EXPECT_TRUE(std::isnan(d.hausdorff_m));
  EXPECT_TRUE(std::isinf(index_of({}).distance({0, 0})));
}

double brute_force(const std::vector<Segment>& segments, const Vec2& p) {
  double nearest = INFINITY;
  for (const Segment& s : segments) {
    const Vec2 side = s.b - s.a;
    const double t = std::clamp((p - s.a).dot(side) / side.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - s.a - t * side).norm());
  }
  return nearest;
}

TEST(SegmentIndex, FindsTheNearestWhateverItsPieces) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0, 1000), around(-3000, 4000);
  std::vector<Segment> segments;
  for (int i = 0; i < 60; ++i) {
    const Vec2 a(anywhere(random), anywhere(random));
    segments.push_back({a, a + Vec2(anywhere(random), anywhere(random)) * (i % 7 == 0 ? 1 : 0.03)});
  }
  for (const double piece : {3.0, 40.0, 700.0}) {
    const SegmentIndex index(segments, piece);
    for (int i = 0; i < 400; ++i) {
      const Vec2 p(around(random), around(random));
      EXPECT_NEAR(index.distance(p), brute_force(segments, p), 1e-9) << piece;
    }
  }
}

TEST(SegmentIndex, ALineHasNoWidth) {
  const SegmentIndex index({{{10, 5}, {90, 5}}}, 4);
  EXPECT_DOUBLE_EQ(index.distance({50, 5}), 0);
  EXPECT_DOUBLE_EQ(index.distance({50, 105}), 100);
  EXPECT_DOUBLE_EQ(index.distance({-20, 5}), 30);
}

}  // namespace
}  // namespace sturz
