// SPDX-License-Identifier: Apache-2.0
// Terrain of which a part is held: the same bits as on the whole, or it says that it needs more.
#include "engine/terrain/held_ground.hpp"

#include "engine/terrain/terrain.hpp"
#include "tests/support/formula_ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sturz {
namespace {

using test::raster_of;

// Coordinates that are no binary fractions: an origin of its own would change bits.
const Grid whole{120, 100, 512345.1, 4600123.7, 0.3, ""};

double hills(double x, double y) {
  return 200 + 1.7 * std::sin(x / 0.9) * std::cos(y / 1.3) - 0.31 * (y - 4600100) +
         (std::fmod(x, 7) < 0.4 ? 3.0 : 0.0);  // with walls
}

std::shared_ptr<const Raster<double>> part_of(const Raster<double>& all, const Window& w) {
  Raster<double> part(grid_of(w, all.grid));
  for (int r = 0; r < w.n_rows; ++r)
    for (int c = 0; c < w.n_cols; ++c) part.at(r, c) = all.at(w.row0 + r, w.col0 + c);
  return std::make_shared<const Raster<double>>(std::move(part));
}

Terrain held(const Raster<double>& all, const Window& w) {
  return {std::make_shared<const HeldGround>(all.grid, part_of(all, w)), NodataRule::outflow};
}

/// A point by rows and columns of nodes.
Vec3 at(double row, double col, double z) {
  return {whole.x_center(0) + col * whole.cell_m, whole.y_center(0) - row * whole.cell_m, z};
}

void expect_same(const SurfaceDistance& a, const SurfaceDistance& b) {
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_EQ(a.normal, b.normal);
}

class HeldGroundTest : public ::testing::Test {
 protected:
  Raster<double> all_ = raster_of(hills, whole);
  Window window_{14, 30, 70, 70};  // tiles of 16 cells around all that is asked for
  Terrain full_ = test::ground_of(all_);
  Terrain part_ = held(all_, window_);
};

TEST_F(HeldGroundTest, AnswersWithTheBitsOfTheWhole) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> row(45, 58), col(54, 72), up(-0.5, 3);
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = at(row(random), col(random), 0);
    const Vec3 q{p.x(), p.y(), full_.height(p.x(), p.y()) + up(random)};
    ASSERT_EQ(part_.height(p.x(), p.y()), full_.height(p.x(), p.y()));
    ASSERT_EQ(part_.surface(p.x(), p.y()).normal, full_.surface(p.x(), p.y()).normal);
    const CurvedSurface a = part_.curved(p.x(), p.y()), b = full_.curved(p.x(), p.y());
    ASSERT_EQ(a.z, b.z);
    ASSERT_EQ(a.curvature_en, b.curvature_en);
    for (const double contact : {0.2, 0.9})
      expect_same(part_.distance(q, contact), full_.distance(q, contact));
    ASSERT_EQ(part_.clearance(q), full_.clearance(q));
  }
  EXPECT_FALSE(part_.needs_more());
  EXPECT_FALSE(full_.needs_more());
}

TEST_F(HeldGroundTest, SaysSoWhereItHoldsNothing) {
  for (const auto& [row, col] :
       {std::pair(10.0, 60.0), {90.0, 60.0}, {50.0, 10.0}, {50.0, 110.0}}) {
    Terrain t = part_;
    const Vec3 p = at(row, col, 0);
    EXPECT_FALSE(t.inside(p.x(), p.y())) << row << ' ' << col;
    EXPECT_TRUE(t.needs_more());
  }
  EXPECT_FALSE(part_.needs_more()) << "a copy's questions are its own";
}

TEST_F(HeldGroundTest, TheRasterOwnEndIsAnEnd) {
  const Window corner{0, 0, 50, 50};
  const Terrain t = held(all_, corner);
  for (const auto& [row, col] : {std::pair(-3.0, 10.0), {10.0, -2.0}, {-5.0, -5.0}}) {
    const Vec3 p = at(row, col, 0);
    EXPECT_FALSE(t.inside(p.x(), p.y()));
    EXPECT_EQ(t.height(p.x(), p.y()), full_.height(p.x(), p.y()));
    EXPECT_FALSE(t.curved(p.x(), p.y()).known);
  }
  EXPECT_FALSE(t.needs_more());
}

TEST_F(HeldGroundTest, NodesBesideTheWindowsEndAreNotTrusted) {
  // Their bounds of slope and curvature miss what lies beyond.
  const int last = window_.end_row() - 1;
  for (const int row : {last, last - 1}) {
    Terrain t = part_;
    EXPECT_TRUE(std::isnan(t.node(row, 60)));
    EXPECT_TRUE(t.needs_more()) << row;
  }
  EXPECT_EQ(part_.node(last - 2, 60), all_.at(last - 2, 60));
  EXPECT_FALSE(part_.needs_more());
}

TEST_F(HeldGroundTest, PatchesAreCountedInRowsOfTheWhole) {
  std::vector<double> dug;
  for (int r = 50; r < 52; ++r)
    for (int c = 60; c < 63; ++c) dug.push_back(all_.at(r, c) - 1);
  dug[2] = nan_d;
  const Terrain a = part_.with_patch(50, 60, 2, 3, dug), b = full_.with_patch(50, 60, 2, 3, dug);
  for (int r = 45; r < 56; ++r)
    for (int c = 55; c < 68; ++c) ASSERT_EQ(a.node(r, c), b.node(r, c));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> row(48, 53), col(58, 64), up(-0.5, 3);
  for (int i = 0; i < 500; ++i) {
    Vec3 p = at(row(random), col(random), 0);
    p.z() = b.height(p.x(), p.y()) + up(random);
    for (const double contact : {0.2, 0.9})
      expect_same(a.distance(p, contact), b.distance(p, contact));
    ASSERT_EQ(a.clearance(p), b.clearance(p));
  }
  EXPECT_FALSE(a.needs_more());
}

TEST_F(HeldGroundTest, APatchBeyondNeedsMore) {
  const Terrain t = part_.with_patch(10, 60, 2, 2, std::vector<double>(4, 1.0));
  EXPECT_TRUE(t.needs_more());
}

TEST_F(HeldGroundTest, ClearanceIsALowerBound) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> row(46, 56), col(56, 70), up(0, 4), way(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    Vec3 p = at(row(random), col(random), 0);
    p.z() = full_.height(p.x(), p.y()) + up(random);
    const double clear = full_.clearance(p);
    const Vec3 q = p + 0.999 * clear * Vec3(way(random), way(random), way(random)).normalized();
    EXPECT_GE(q.z(), full_.height(q.x(), q.y()) - 1e-9);
  }
}

TEST(HeldGround, UnknownNodesFarAwayDoNotMatter) {
  Raster<double> all = raster_of(hills, whole);
  all.at(95, 5) = nan_d;
  const Terrain t = test::ground_of(all);
  const Vec3 near = at(90, 8, 300), far = at(30, 80, 300);
  EXPECT_EQ(t.clearance(near), 0);
  EXPECT_GT(t.clearance(far), 0);
}

TEST(Windows, AreGridsOfTheirOwnAndBack) {
  const Window w{20, 30, 60, 64};
  const Grid part = grid_of(w, whole);
  EXPECT_EQ(window_of(part, whole), w);
  EXPECT_NEAR(part.x_center(0), whole.x_center(30), 1e-9);
  EXPECT_EQ(widened(w, 25, whole), (Window{0, 5, 100, 114}));
  EXPECT_EQ(joined(Window{}, w), w);
  EXPECT_EQ(joined(Window{1, 2, 3, 4}, w), (Window{1, 2, 79, 92}));
}

}  // namespace
}  // namespace sturz
