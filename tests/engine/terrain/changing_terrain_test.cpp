// SPDX-License-Identifier: Apache-2.0
// Ground that changes under a member equals ground that was so from the start.
#include "engine/terrain/terrain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

namespace sturz {
namespace {

Raster<double> waves(int n) {
  Raster<double> z(Grid{n, n, 0, 5.0 * n, 5, ""});
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) z.at(r, c) = 8 * std::sin(0.3 * r) * std::cos(0.2 * c) - 0.5 * c;
  return z;
}

Terrain terrain_of(Raster<double> z) {
  return {std::make_shared<const Raster<double>>(std::move(z)), NodataRule::outflow};
}

/// Random nodes of a spot that grows and wanders, lowered by up to 3 m.
std::vector<NodeChange> erosion(const Terrain& t, int step, std::mt19937& random) {
  std::vector<NodeChange> out;
  std::uniform_int_distribution<int> row(10 + step, 20 + 2 * step), col(12, 18 + 3 * step);
  std::uniform_real_distribution<double> depth(0, 3);
  for (int k = 0; k < 25; ++k) {
    const int r = row(random), c = col(random);
    out.push_back({r, c, t.node(r, c) - depth(random)});
  }
  return out;
}

TEST(ChangingTerrain, EqualsOneThatWasSoFromTheStart) {
  Raster<double> now = waves(60);
  Terrain changing = terrain_of(now);
  std::mt19937 random(5);
  for (int step = 0; step < 12; ++step) {
    const auto nodes = erosion(changing, step, random);
    changing.change(nodes);
    for (const NodeChange& n : nodes) now.at(n.row, n.col) = n.z;
  }
  EXPECT_EQ(changing.n_changes(), 12u);
  const Terrain whole = terrain_of(now);
  std::uniform_real_distribution<double> place(3, 297), above(-0.5, 4);
  for (int k = 0; k < 4000; ++k) {
    const double x = place(random), y = place(random);
    ASSERT_EQ(changing.height(x, y), whole.height(x, y));
    ASSERT_EQ(changing.surface(x, y).normal, whole.surface(x, y).normal);
    ASSERT_EQ(changing.curved(x, y).curvature_ee, whole.curved(x, y).curvature_ee);
    // Bounds decide how a distance is found: they must know the new steps of the ground.
    const Vec3 p(x, y, whole.height(x, y) + above(random));
    ASSERT_NEAR(changing.distance(p, 1).distance, whole.distance(p, 1).distance, 1e-12);
    ASSERT_LE(changing.clearance(p), std::abs(whole.distance(p, 5).distance) + 1e-9);
  }
}

TEST(ChangingTerrain, LeavesTheSharedBaseAndOtherMembersAlone) {
  const Terrain base = terrain_of(waves(40));
  Terrain one = base, other = base;
  const double before = base.node(20, 20);
  one.change(std::vector<NodeChange>{{20, 20, before - 5}});
  EXPECT_EQ(one.node(20, 20), before - 5);
  EXPECT_EQ(base.node(20, 20), before);
  EXPECT_EQ(other.node(20, 20), before);
  EXPECT_EQ(other.patch_bytes(), 0u);
}

TEST(ChangingTerrain, KeepsAnExcavationAndWorksAtTheEdgeOfTheRaster) {
  Terrain t = terrain_of(waves(30)).with_patch(4, 4, 2, 2, {1, 2, 3, 4});
  t.change(std::vector<NodeChange>{{0, 0, -7}, {29, 29, -9}});
  EXPECT_EQ(t.node(4, 4), 1);
  EXPECT_EQ(t.node(5, 5), 4);
  EXPECT_EQ(t.node(0, 0), -7);
  EXPECT_EQ(t.node(29, 29), -9);
}

TEST(ChangingTerrain, DoesNotMoveThePatchEveryTime) {
  Terrain t = terrain_of(waves(200));
  int moves = 0;
  std::size_t bytes = 0;
  for (int step = 0; step < 150; ++step) {  // a front that moves by a cell a step
    t.change(std::vector<NodeChange>{{20 + step, 100, -3.0 - step}});
    moves += t.patch_bytes() != bytes;
    bytes = t.patch_bytes();
  }
  EXPECT_LE(moves, 20);
  EXPECT_LT(bytes, sizeof(double) * 200 * 200) << "the patch follows what changed";
}

TEST(ChangingTerrain, RefusesNodesOffTheGridOrWithoutAHeight) {
  Terrain t = terrain_of(waves(10));
  EXPECT_THROW(t.change(std::vector<NodeChange>{{10, 0, 1}}), std::logic_error);
  EXPECT_THROW(t.change(std::vector<NodeChange>{{0, 0, nan_d}}), std::logic_error);
}

}  // namespace
}  // namespace sturz
