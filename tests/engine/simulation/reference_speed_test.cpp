// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/reference_speed.hpp"

#include "engine/core/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

namespace sturz {
namespace {

constexpr double g = standard_gravity;

Terrain terrain_of(const std::function<double(double, double)>& f, double cell = 5,
                   int n_cols = 400, int n_rows = 60) {
  auto r = std::make_shared<Raster<double>>(Grid{n_cols, n_rows, 0, n_rows * cell, cell, ""});
  for (int i = 0; i < n_rows; ++i)
    for (int j = 0; j < n_cols; ++j) r->at(i, j) = f(r->grid.x_center(j), r->grid.y_center(i));
  return {r, NodataRule::outflow};
}

Release point_at(const Terrain& t, double x, double y, double thickness = 0) {
  Release r;
  r.x = {x}, r.y = {y}, r.z = {t.height(x, y)};
  r.max_thickness_m = thickness;
  return r;
}

TEST(ReferenceSpeed, InclineGivesTheClosedForm) {
  for (double tan_slope : {0.5, 0.9, 1.6})
    for (double mu : {0.0, 0.2, 0.45}) {
      const Terrain t = terrain_of([&](double x, double) { return -tan_slope * x; });
      const double time = 10;
      const double cosine = 1 / std::sqrt(1 + tan_slope * tan_slope);
      const double acceleration = g * cosine * (tan_slope - mu);
      const double v = reference_speed(t, point_at(t, 50, 150), mu, 0, time);
      const double run = 0.5 * acceleration * time * time;
      ASSERT_LT(50 + run * cosine, 1990);
      EXPECT_NEAR(v, acceleration * time, 0.01 * v) << tan_slope << ' ' << mu;
      EXPECT_NEAR(v, std::sqrt(2 * acceleration * run), 0.01 * v);
    }
}

TEST(ReferenceSpeed, EnergyLineGivesTheSpeedAtTheFoot) {
  // 30 degrees over 500 m, rounded into a flat: v^2 / 2 = g (drop - mu * horizontal distance),
  // the rounding adds friction by its centripetal force: exp(-2 mu theta).
  const double slope = std::tan(M_PI / 6), mu = 0.25;
  const Terrain t = terrain_of([&](double x, double) { return x < 600 ? (600 - x) * slope : 0.0; });
  const double v = reference_speed(t, point_at(t, 100, 150), mu, 0, 300);
  EXPECT_NEAR(v, std::sqrt(2 * g * 500 * (slope - mu)), 0.02 * v);
}

TEST(ReferenceSpeed, InitialSpeedIsLostWhereFrictionHolds) {
  const Terrain t = terrain_of([](double x, double) { return -0.2 * x; });
  EXPECT_NEAR(reference_speed(t, point_at(t, 100, 150), 0.5, 12, 100), 12, 1e-9);
  const double faster = reference_speed(t, point_at(t, 100, 150), 0.0, 12, 20);
  EXPECT_NEAR(faster, 12 + g * 0.2 / std::sqrt(1.04) * 20, 0.01 * faster);
}

TEST(ReferenceSpeed, NeverFallsBelowTheThicknessOfTheRelease) {
  const Terrain t = terrain_of([](double, double) { return 7.0; });
  EXPECT_NEAR(reference_speed(t, point_at(t, 100, 150, 20), 0.3, 0, 100), std::sqrt(g * 20), 1e-12);
  EXPECT_EQ(reference_speed(t, Release{}, 0.3, 0, 100), 0);
}

TEST(ReferenceSpeed, NeverExceedsWhatGravityGives) {
  // Cliffs, detachments and noise of two metres from node to node.
  const auto rough = [](double x, double y) {
    const int k = static_cast<int>(x / 5) * 31 + static_cast<int>(y / 5) * 17;
    return 400 - 0.2 * x - 80 * (x > 500) - 60 * (x > 900) + 2 * std::sin(k * 1.7);
  };
  const Terrain t = terrain_of(rough);
  const double lowest = 400 - 0.2 * 2000 - 140 - 2;
  for (double mu : {0.0, 0.1, 0.3}) {
    const double v = reference_speed(t, point_at(t, 450, 150), mu, 5, 200);
    EXPECT_TRUE(std::isfinite(v));
    EXPECT_LE(v, std::sqrt(25 + 2 * g * (t.height(450, 150) - lowest)));
    EXPECT_GE(v, 5);
  }
  // Something must come of the cliffs too: 80 m of them, less friction and landing.
  EXPECT_GT(reference_speed(t, point_at(t, 480, 150), 0.1, 5, 200), 20);
}

TEST(ReferenceSpeed, PitsNodataAndBoundariesAreSurvived) {
  const Terrain pit = terrain_of([](double x, double y) {
    const double r = std::hypot(x - 500, y - 150);
    return r > 400 ? nan_d : 0.002 * r * r;
  });
  const double drop = 0.002 * 100 * 100;
  const double v = reference_speed(pit, point_at(pit, 600, 150), 0.0, 0, 120);
  EXPECT_NEAR(v, std::sqrt(2 * g * drop), 0.03 * v);
  EXPECT_LT(reference_speed(pit, point_at(pit, 600, 150), 0.1, 0, 120), v);
  const Terrain out = terrain_of([](double x, double) { return x > 300 ? nan_d : -0.6 * x; });
  EXPECT_NEAR(reference_speed(out, point_at(out, 100, 150), 0.1, 0, 1000),
              std::sqrt(2 * g * 0.5 * 195), 3);
}

TEST(ReferenceSpeed, TakesTheFastestOfManyStarts) {
  const Terrain t = terrain_of([](double x, double) { return x < 700 ? (700 - x) * 0.6 : 0.0; });
  Release r;
  for (int i = 0; i < 1000; ++i) {
    r.x.push_back(690 - 0.5 * i);
    r.y.push_back(150);
    r.z.push_back(t.height(r.x.back(), 150));
  }
  const double highest = reference_speed(t, point_at(t, r.x.back(), 150), 0.2, 0, 200);
  EXPECT_EQ(reference_speed(t, r, 0.2, 0, 200), highest);
}

TEST(ReferenceSpeed, DoesNotChangeWhenTheGroundIsTurned) {
  const double a = 0.4;
  const auto ground = [](double s) { return s < 500 ? (500 - s) * 0.7 : 0.04 * (s - 500); };
  const Terrain straight = terrain_of([&](double x, double) { return ground(x); }, 5, 300, 200);
  const Terrain turned = terrain_of(
      [&](double x, double y) { return ground(std::cos(a) * x + std::sin(a) * (y - 200)); }, 5, 300,
      200);
  const double v0 = reference_speed(straight, point_at(straight, 150, 200), 0.25, 0, 100);
  const double v1 = reference_speed(
      turned, point_at(turned, 150 * std::cos(a), 200 + 150 * std::sin(a)), 0.25, 0, 100);
  EXPECT_NEAR(v1, v0, 0.01 * v0);
}

}  // namespace
}  // namespace sturz
