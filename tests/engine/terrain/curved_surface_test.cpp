// SPDX-License-Identifier: Apache-2.0
/// The rounded ground under columns: exact where it can be, smooth everywhere, honest at its edges.
#include "engine/terrain/terrain.hpp"
#include "tests/support/formula_ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace sturz {
namespace {

using test::ground_of;
using test::raster_of;

constexpr double cell = 5;
const Grid grid{20, 16, 0, 0, cell, ""};  // x in 0..100, y in -80..0

double rough(double x, double y) {
  return 40 + 9 * std::sin(x / 7) * std::cos(y / 5) + 0.3 * x - 0.1 * y;
}

/// A raster whose cells change without any order.
Raster<double> rubble(unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> up(0, 20);
  return raster_of([&](double, double) { return up(random); }, grid);
}

/// Map points whose stencils of 3 x 3 nodes lie on the grid.
std::vector<Vec2> inner_points(int n, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(cell, 95), y(-75, -cell);
  std::vector<Vec2> points;
  for (int k = 0; k < n; ++k) points.emplace_back(x(random), y(random));
  return points;
}

void expect_same(const CurvedSurface& a, const CurvedSurface& b, double x, double y) {
  EXPECT_EQ(a.known, b.known) << x << " " << y;
  EXPECT_EQ(a.z, b.z) << x << " " << y;
  EXPECT_EQ(a.east, b.east) << x << " " << y;
  EXPECT_EQ(a.north, b.north) << x << " " << y;
  EXPECT_EQ(a.curvature_ee, b.curvature_ee) << x << " " << y;
  EXPECT_EQ(a.curvature_en, b.curvature_en) << x << " " << y;
  EXPECT_EQ(a.curvature_nn, b.curvature_nn) << x << " " << y;
}

TEST(CurvedSurface, IsExactOnPlanesOfAnyTilt) {
  for (const double east : {0.0, -0.6, 3.0})
    for (const double north : {0.0, 0.25, -5.0}) {
      const auto plane = [&](double x, double y) { return 100 + east * x + north * y; };
      const Terrain t = ground_of(plane, grid);
      for (const Vec2& p : inner_points(50)) {
        const CurvedSurface s = t.curved(p.x(), p.y());
        EXPECT_TRUE(s.known);
        EXPECT_NEAR(s.z, plane(p.x(), p.y()), 1e-11);
        EXPECT_NEAR(s.east, east, 1e-12);
        EXPECT_NEAR(s.north, north, 1e-12);
        for (const double curvature : {s.curvature_ee, s.curvature_en, s.curvature_nn})
          EXPECT_NEAR(curvature, 0, 1e-12);
      }
    }
}

TEST(CurvedSurface, IsExactOnQuadraticsButForItsRounding) {
  const double ee = 0.02, en = -0.013, nn = 0.006;
  const auto z = [&](double x, double y) {
    return 7 + 0.3 * x - 0.2 * y + 0.5 * ee * x * x + en * x * y + 0.5 * nn * y * y;
  };
  const Terrain t = ground_of(z, grid);
  // The weights' second moment about a point is a quarter of a cell squared in each direction.
  const double rounding = cell * cell / 8 * (ee + nn);
  for (const Vec2& p : inner_points(200)) {
    const double x = p.x(), y = p.y();
    const CurvedSurface s = t.curved(x, y);
    EXPECT_NEAR(s.z, z(x, y) + rounding, 1e-11);
    EXPECT_NEAR(s.east, 0.3 + ee * x + en * y, 1e-12);
    EXPECT_NEAR(s.north, -0.2 + en * x + nn * y, 1e-12);
    EXPECT_NEAR(s.curvature_ee, ee, 1e-12);
    EXPECT_NEAR(s.curvature_en, en, 1e-12);
    EXPECT_NEAR(s.curvature_nn, nn, 1e-12);
  }
}

TEST(CurvedSurface, SlopesAndBendsAreDerivativesOfItsHeight) {
  const Terrain t = ground_of(rubble());
  const double step = 1e-4;
  for (const Vec2& p : inner_points(200)) {
    const double x = p.x(), y = p.y();
    const CurvedSurface s = t.curved(x, y);
    const CurvedSurface e = t.curved(x + step, y), w = t.curved(x - step, y);
    const CurvedSurface n = t.curved(x, y + step), o = t.curved(x, y - step);
    // Exact within a patch of the spline; over a border second derivatives jump, by at most
    // 80 m / (5 m)^2 for nodes that differ by 20 m.
    EXPECT_NEAR((e.z - w.z) / (2 * step), s.east, 3.2 * step);
    EXPECT_NEAR((n.z - o.z) / (2 * step), s.north, 3.2 * step);
    if (std::abs(std::remainder(x, cell)) < step || std::abs(std::remainder(y, cell)) < step)
      continue;
    EXPECT_NEAR((e.east - w.east) / (2 * step), s.curvature_ee, 1e-7);
    EXPECT_NEAR((e.north - w.north) / (2 * step), s.curvature_en, 1e-7);
    EXPECT_NEAR((n.north - o.north) / (2 * step), s.curvature_nn, 1e-7);
  }
}

TEST(CurvedSurface, HeightsAndSlopesAreContinuousAcrossCellBorders) {
  const Terrain t = ground_of(rubble());
  const double hair = 1e-9;
  auto expect_close = [](const CurvedSurface& a, const CurvedSurface& b) {
    EXPECT_NEAR(a.z, b.z, 1e-7);
    EXPECT_NEAR(a.east, b.east, 1e-7);
    EXPECT_NEAR(a.north, b.north, 1e-7);
  };
  double curvature_jump = 0;
  for (int k = 2; k < 19; ++k)
    for (const double along : {-7.3, -31.1, -40.0, -62.9}) {
      const double x = k * cell;
      const CurvedSurface west = t.curved(x - hair, along), east = t.curved(x + hair, along);
      expect_close(west, east);
      curvature_jump = std::max(curvature_jump, std::abs(west.curvature_ee - east.curvature_ee));
    }
  for (int k = 2; k < 15; ++k)
    for (const double along : {7.3, 31.1, 50.0, 90.9})
      expect_close(t.curved(along, -k * cell - hair), t.curved(along, -k * cell + hair));
  EXPECT_GT(curvature_jump, 0.1) << "borders of the spline's patches were looked at";
}

TEST(CurvedSurface, StaysWithinTheNodesAroundIt) {
  const Raster<double> nodes = rubble();
  const Terrain t = ground_of(nodes);
  for (const Vec2& p : inner_points(300)) {
    const int row = grid.row_of(p.y()), col = grid.col_of(p.x());
    double low = 1e300, high = -1e300;
    for (int r = row - 1; r <= row + 1; ++r)
      for (int c = col - 1; c <= col + 1; ++c) {
        low = std::min(low, nodes.at(r, c));
        high = std::max(high, nodes.at(r, c));
      }
    const CurvedSurface s = t.curved(p.x(), p.y());
    EXPECT_GE(s.z, low);
    EXPECT_LE(s.z, high);
  }
}

/// What with_patch shows against a ground built with the patched raster.
void expect_patch_seen(int row0, int col0, int n_rows, int n_cols) {
  Raster<double> nodes = rubble();
  const Terrain base = ground_of(nodes);
  std::vector<double> patch;
  for (int r = row0; r < row0 + n_rows; ++r)
    for (int c = col0; c < col0 + n_cols; ++c) {
      patch.push_back(nodes.at(r, c) - 5 - r - 2 * c);
      nodes.at(r, c) = patch.back();
    }
  const Terrain patched = base.with_patch(row0, col0, n_rows, n_cols, patch);
  const Terrain whole = ground_of(nodes);
  bool changed = false;
  for (double y = -79; y < 0; y += 0.73)
    for (double x = 1; x < 100; x += 0.73) {
      expect_same(patched.curved(x, y), whole.curved(x, y), x, y);
      changed |= patched.curved(x, y).z != base.curved(x, y).z;
    }
  EXPECT_TRUE(changed);
}

TEST(CurvedSurface, SeesAPatchAlsoWhereItsNodesStraddleTheEdge) { expect_patch_seen(6, 7, 4, 5); }

TEST(CurvedSurface, SeesAPatchOfOneNode) { expect_patch_seen(8, 10, 1, 1); }

TEST(CurvedSurface, SeesAPatchAtTheCornersOfTheGrid) {
  expect_patch_seen(0, 0, 3, 2);
  expect_patch_seen(12, 17, 4, 3);
}

TEST(CurvedSurface, SeesPatchesThatAddUp) {
  Raster<double> nodes = rubble();
  const Terrain both = ground_of(nodes)
                           .with_patch(2, 2, 2, 2, {1, 2, 3, 4})
                           .with_patch(9, 11, 1, 3, {-7, nan_d, -9});
  nodes.at(2, 2) = 1, nodes.at(2, 3) = 2, nodes.at(3, 2) = 3, nodes.at(3, 3) = 4;
  nodes.at(9, 11) = -7, nodes.at(9, 13) = -9;
  const Terrain whole = ground_of(nodes);
  for (double y = -79; y < 0; y += 0.73)
    for (double x = 1; x < 100; x += 0.73) expect_same(both.curved(x, y), whole.curved(x, y), x, y);
}

/// The bilinear surface, without curvature.
void expect_bilinear(const Terrain& t, double x, double y) {
  const CurvedSurface s = t.curved(x, y);
  const SurfacePoint flat = t.surface(x, y);
  EXPECT_TRUE(s.known) << x << " " << y;
  EXPECT_EQ(s.z, flat.z) << x << " " << y;
  EXPECT_LT((upward_normal(s.east, s.north) - flat.normal).norm(), 1e-14) << x << " " << y;
  EXPECT_EQ(s.curvature(1, 2), 0) << x << " " << y;
}

TEST(CurvedSurface, IsBilinearBesideUnknownCells) {
  Raster<double> nodes = raster_of(rough, grid);
  nodes.at(7, 9) = nan_d;
  const Terrain t = ground_of(nodes);
  const double x = grid.x_center(9), y = grid.y_center(7);
  // Outside the four blocks that the unknown node spoils, within the stencil.
  expect_bilinear(t, x + 1.2 * cell, y);
  expect_bilinear(t, x - 1.4 * cell, y + 0.3 * cell);
  expect_bilinear(t, x + 1.1 * cell, y - 1.1 * cell);
  EXPECT_NE(t.curved(x + 1.6 * cell, y).curvature(1, 0), 0) << "farther on it is smooth again";
  const CurvedSurface hole = t.curved(x + 0.9 * cell, y);
  EXPECT_FALSE(hole.known);
  EXPECT_TRUE(std::isfinite(hole.z));
}

TEST(CurvedSurface, IsBilinearBetweenTheOutermostNodes) {
  const Terrain t = ground_of(raster_of(rough, grid));
  for (const double y : {-2.6, -40.0, -77.4}) {
    expect_bilinear(t, 2.5, y);
    expect_bilinear(t, 4.9, y);
    expect_bilinear(t, 97.5, y);
  }
  expect_bilinear(t, 50, -2.5);
  expect_bilinear(t, 50, -77.5);
}

TEST(CurvedSurface, IsUnknownAndLevelOutside) {
  const Terrain t = ground_of(raster_of(rough, grid));
  for (const Vec2& p :
       {Vec2(1, -40), Vec2(99, -40), Vec2(50, -1), Vec2(50, -79), Vec2(-1e6, 1e7)}) {
    const CurvedSurface s = t.curved(p.x(), p.y());
    EXPECT_FALSE(s.known);
    EXPECT_EQ(s.z, t.height(p.x(), p.y()));
    EXPECT_EQ(s.east, 0);
    EXPECT_EQ(s.north, 0);
    EXPECT_EQ(s.curvature(3, 4), 0);
  }
  EXPECT_FALSE(t.curved(nan_d, -40).known);
}

TEST(CurvedSurface, BendIsTheSecondDerivativeAlongAVelocity) {
  CurvedSurface s;
  s.curvature_ee = 0.1, s.curvature_en = -0.02, s.curvature_nn = 0.03;
  const double vx = 3, vy = -4;  // speed 5: d2z/ds2 of the profile along (0.6, -0.8), times 25
  EXPECT_NEAR(s.curvature(vx, vy), 25 * (0.1 * 0.36 + 2 * 0.02 * 0.48 + 0.03 * 0.64), 1e-15);
}

}  // namespace
}  // namespace sturz
