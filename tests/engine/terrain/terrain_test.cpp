// SPDX-License-Identifier: Apache-2.0
#include "engine/terrain/terrain.hpp"

#include "engine/core/error.hpp"
#include "tests/support/formula_ground.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

namespace sturz {
namespace {

using test::Height;

std::shared_ptr<Raster<double>> raster_of(const Height& f, int n_cols, int n_rows, double cell,
                                          double west = 0, double north = 0) {
  return std::make_shared<Raster<double>>(
      test::raster_of(f, Grid{n_cols, n_rows, west, north, cell, ""}));
}

Terrain terrain_of(const Height& f, int n_cols = 20, int n_rows = 16, double cell = 5) {
  return {raster_of(f, n_cols, n_rows, cell), NodataRule::outflow};
}

/// Slow twin: the nearest of a dense cloud of surface points, signed by height.
double distance_by_sampling(const Terrain& t, const Vec3& p, double around, double step) {
  double best2 = 1e300;
  for (double x = p.x() - around; x <= p.x() + around; x += step)
    for (double y = p.y() - around; y <= p.y() + around; y += step)
      if (t.inside(x, y)) best2 = std::min(best2, (p - Vec3(x, y, t.height(x, y))).squaredNorm());
  return std::copysign(std::sqrt(best2), p.z() - t.height(p.x(), p.y()));
}

TEST(Terrain, PlaneHasItsHeightAndNormalEverywhere) {
  const Terrain t = terrain_of([](double x, double y) { return 100 - 0.5 * x + 0.25 * y; });
  const Vec3 n = Vec3(0.5, -0.25, 1).normalized();
  for (double x : {3.0, 17.5, 41.3, 97.4})
    for (double y : {-3.0, -22.5, -76.0}) {
      const SurfacePoint s = t.surface(x, y);
      EXPECT_NEAR(s.z, 100 - 0.5 * x + 0.25 * y, 1e-11);
      EXPECT_EQ(s.z, t.height(x, y));
      EXPECT_LT((s.normal - n).norm(), 1e-12);
    }
}

TEST(Terrain, IsBilinearBetweenNodesAndExactOnThem) {
  const Height saddle = [](double x, double y) { return 3 + 0.02 * x * y - 0.1 * x + 0.3 * y; };
  const Terrain t = terrain_of(saddle);
  for (double x : {2.5, 4.0, 33.3, 90.1})
    for (double y : {-2.5, -6.1, -40.0, -70.2}) {
      EXPECT_NEAR(t.height(x, y), saddle(x, y), 1e-11);
      const Vec3 n = Vec3(-(0.02 * y - 0.1), -(0.02 * x + 0.3), 1).normalized();
      EXPECT_LT((t.surface(x, y).normal - n).norm(), 1e-11);
    }
  EXPECT_EQ(t.height(12.5, -7.5), t.node(1, 2));
  EXPECT_EQ(t.height(97.5, -77.5), t.node(15, 19));
}

TEST(Terrain, DistanceToAPlaneIsExactAtAnySlopeAndSide) {
  for (double slope : {0.0, 0.3, 0.99, 1.5, 4.0})
    for (double turn : {0.0, 0.7, 2.0}) {
      const double a = slope * std::cos(turn), b = slope * std::sin(turn);
      const Terrain t = terrain_of([&](double x, double y) { return a * x + b * y; });
      const Vec3 n = Vec3(-a, -b, 1).normalized();
      for (double contact_distance : {1.0, 4.9, 12.0})
        for (double d : {-0.7, -1e-3, 0.0, 0.2, 0.9})
          for (double shift : {0.0, 1.3, 2.5, 4.9}) {
            const Vec3 foot(50 + shift, -40 - 0.7 * shift,
                            a * (50 + shift) - b * (40 + 0.7 * shift));
            const SurfaceDistance s = t.distance(foot + d * contact_distance * n, contact_distance);
            EXPECT_NEAR(s.distance, d * contact_distance, 1e-9)
                << slope << ' ' << turn << ' ' << contact_distance;
            EXPECT_LT((s.normal - n).norm(), 1e-6) << slope << ' ' << turn << ' ' << d;
          }
    }
}

TEST(Terrain, SeesACliffBesideTheParticle) {
  // Flat up to x = 52.5, then 60 degrees up.
  const double tan60 = std::sqrt(3.0);
  const Terrain t =
      terrain_of([&](double x, double) { return x > 52.5 ? (x - 52.5) * tan60 : 0.0; });
  const double contact_distance = 2;
  for (double x : {50.0, 51.0, 52.0, 52.4, 52.5, 53.0})
    for (double z : {0.5, 1.0, 1.8}) {
      const Vec3 p(x, -31.0, z);
      const double to_floor = z;
      const double to_cliff = ((52.5 - x) * tan60 + z) * 0.5;
      const double exact = x < 52.5 ? std::min(to_floor, to_cliff) : to_cliff;
      if (x > 52.5 && z < (x - 52.5) * tan60) continue;
      EXPECT_NEAR(t.distance(p, contact_distance).distance, exact, 1e-6) << x << ' ' << z;
    }
}

TEST(Terrain, DistanceNeverLiesAboutTheSideNorJumpsAcrossSeams) {
  // Pit, ridge, 60 degree cliff and noise in one ground.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit;
  const Terrain t = terrain_of([&](double x, double y) {
    const double pit = -12 * std::exp(-(std::pow(x - 30, 2) + std::pow(y + 40, 2)) / 40);
    const double ridge = std::max(0.0, 8 - 1.5 * std::abs(y + 20));
    const double cliff = 1.7 * std::clamp(x - 70, 0.0, 12.0);
    return pit + ridge + cliff + 0.3 * unit(random);
  });
  const double contact_distance = 2.5;
  for (int i = 0; i < 4000; ++i) {
    const double x = 6 + 86 * unit(random), y = -6 - 66 * unit(random);
    const double above = contact_distance * (2 * unit(random) - 0.5);
    const Vec3 p(x, y, t.height(x, y) + above);
    const SurfaceDistance s = t.distance(p, contact_distance);
    ASSERT_TRUE(std::isfinite(s.distance));
    ASSERT_EQ(s.distance > 0, above > 0) << p.transpose();
    ASSERT_NEAR(s.normal.norm(), 1, 1e-12);
    ASSERT_GT(s.normal.z(), 0) << p.transpose();
    ASSERT_LE(std::abs(s.distance), std::abs(above) + 1e-12);
    if (std::abs(s.distance) > contact_distance) continue;
    // Distance is a contraction; the tangent plane's share of it may miss by a few per cent.
    const Vec3 step =
        0.01 * contact_distance * Vec3(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
    const double jump = std::abs(t.distance(p + step, contact_distance).distance - s.distance);
    ASSERT_LT(jump, step.norm() + 0.05 * contact_distance) << p.transpose();
  }
}

TEST(Terrain, DistanceMatchesADenseSearch) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit;
  const Terrain t = terrain_of([&](double x, double y) {
    return 6 * std::sin(x / 6) * std::cos(y / 9) + (x > 60 ? 9.0 : 0.0) + 0.5 * unit(random);
  });
  const double contact_distance = 2.5;
  int compared = 0;
  for (int i = 0; i < 150; ++i) {
    const double x = 10 + 78 * unit(random), y = -10 - 58 * unit(random);
    const Vec3 p(x, y, t.height(x, y) + contact_distance * (2.5 * unit(random) - 0.5));
    const SurfaceDistance s = t.distance(p, contact_distance);
    const double exact = distance_by_sampling(t, p, 2 * contact_distance, 0.05);
    if (std::abs(exact) > contact_distance) {
      EXPECT_GT(std::abs(s.distance), 0.97 * contact_distance);
      continue;
    }
    ++compared;
    EXPECT_NEAR(s.distance, exact, 0.05 * contact_distance) << p.transpose();
  }
  EXPECT_GT(compared, 60);
}

TEST(Terrain, GroundFinerThanTheContactDistanceKeepsItsCliffs) {
  const double tan60 = std::sqrt(3.0);
  const Terrain t =
      terrain_of([&](double x, double) { return x > 20 ? (x - 20) * tan60 : 0.0; }, 80, 60, 0.5);
  const double contact_distance = 3;
  for (double x : {17.0, 18.0, 19.0, 19.9}) {
    const double exact = std::min(2.5, ((20 - x) * tan60 + 2.5) * 0.5);
    EXPECT_NEAR(t.distance({x, -15, 2.5}, contact_distance).distance, exact,
                0.12 * contact_distance)
        << x;
  }
}

TEST(Terrain, NodataIsOutsideAndContinuedLevel) {
  auto r = raster_of([](double x, double) { return 10 + x; }, 12, 10, 2);
  for (int i = 3; i < 6; ++i)
    for (int j = 4; j < 8; ++j) r->at(i, j) = nan_d;
  const Terrain t(r, NodataRule::wall);
  EXPECT_EQ(t.nodata_rule(), NodataRule::wall);
  EXPECT_TRUE(t.inside(3.0, -9.0));
  EXPECT_FALSE(t.inside(12.0, -9.0));  // in the hole
  EXPECT_FALSE(t.inside(0.5, -9.0));   // beyond the outermost nodes
  EXPECT_FALSE(t.inside(-100, 50));
  EXPECT_FALSE(t.inside(nan_d, 0));
  EXPECT_TRUE(t.inside(23.0, -19.0));            // the last node itself
  EXPECT_NEAR(t.height(-50, -9), 11, 1e-12);     // first node column at x = 1
  EXPECT_NEAR(t.height(8.0, -9.0), 17, 1e-12);   // hole's western known edge at x = 7
  EXPECT_NEAR(t.height(16.5, -9.0), 27, 1e-12);  // and its eastern one at x = 17
  EXPECT_EQ(t.surface(8.0, -9.0).normal, Vec3(0, 0, 1));
  EXPECT_NEAR(t.distance({-50, -9, 13}, 1).distance, 2, 1e-12);
  EXPECT_TRUE(std::isnan(t.height(nan_d, -9)));
  EXPECT_TRUE(std::isfinite(t.distance({7.0, -9.0, 17.5}, 1).distance));
}

TEST(Terrain, BeyondTheSearchTheGroundLiesAtItsLowest) {
  auto r = raster_of([](double, double) { return nan_d; }, 300, 4, 1);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) r->at(i, j) = 50 + i;
  const Terrain t(r, NodataRule::outflow);
  EXPECT_EQ(t.height(250, -2), 50);
  EXPECT_EQ(t.height(20.5, -1.5), 51);
}

TEST(Terrain, PatchReplacesOnlyItsNodesAndStacks) {
  const Height f = [](double x, double y) { return 0.1 * x - 0.2 * y; };
  const Terrain base = terrain_of(f);
  const Terrain dug = base.with_patch(4, 6, 2, 3, {1, 2, nan_d, 4, 5, 6});
  EXPECT_EQ(dug.node(4, 6), 1);
  EXPECT_EQ(dug.node(4, 8), base.node(4, 8));
  EXPECT_EQ(dug.node(5, 8), 6);
  EXPECT_EQ(base.node(5, 8), f(42.5, -27.5));
  const Terrain twice = dug.with_patch(11, 15, 1, 1, {70});
  EXPECT_EQ(twice.node(4, 6), 1);
  EXPECT_EQ(twice.node(11, 15), 70);
  // The patched ground answers like a raster with the same nodes.
  auto plain = raster_of(f, 20, 16, 5);
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 20; ++j) plain->at(i, j) = twice.node(i, j);
  const Terrain same(plain, NodataRule::outflow);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < 2000; ++i) {
    const double x = 3 + 94 * unit(random), y = -3 - 74 * unit(random);
    ASSERT_EQ(twice.height(x, y), same.height(x, y));
    const Vec3 p(x, y, same.height(x, y) + 3 * unit(random) - 1);
    ASSERT_NEAR(twice.distance(p, 2).distance, same.distance(p, 2).distance, 0.05 * 2);
  }
}

TEST(Terrain, PatchCanFillNodataAndCutIt) {
  auto r = raster_of([](double, double) { return 5.0; }, 6, 6, 1);
  r->at(2, 2) = nan_d;
  const Terrain t(r, NodataRule::outflow);
  EXPECT_FALSE(t.inside(2.6, -2.6));
  EXPECT_TRUE(t.with_patch(2, 2, 1, 1, {5.0}).inside(2.6, -2.6));
  EXPECT_THROW(t.with_patch(5, 5, 2, 2, {1, 1, 1, 1}), std::logic_error);
}

TEST(Terrain, RefusesGroundWithoutASurface) {
  EXPECT_THROW(Terrain(raster_of([](double, double) { return 1.0; }, 1, 5, 1), NodataRule::wall),
               SetupError);
  try {
    Terrain(raster_of([](double, double) { return nan_d; }, 5, 5, 1), NodataRule::wall);
    FAIL() << "a ground of nodata was accepted";
  } catch (const SetupError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("nodata"));
  }
}

TEST(SurfaceBounds, HoldForThePatchesWithinOneCell) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit;
  const auto r = raster_of([&](double, double) { return 3 * unit(random); }, 9, 8, 2);
  const Terrain t(r, NodataRule::outflow);
  const auto bounds = surface_bounds(r->values, 8, 9, 2);
  for (int row = 0; row < 7; ++row)
    for (int col = 0; col < 8; ++col)
      for (int k = 0; k < 60; ++k) {
        const double x = std::clamp(r->grid.x_center(col) + 6 * unit(random) - 2, 1.0, 17.0);
        const double y = std::clamp(r->grid.y_center(row) - 6 * unit(random) + 2, -15.0, -1.0);
        ASSERT_LE(bounds[row * 9 + col].min_normal_z, t.surface(x, y).normal.z());
      }
}

}  // namespace
}  // namespace sturz
