// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/peak_maps.hpp"

#include "tests/support/peak_map_reading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace sturz {
namespace {

using test::at;
using test::maps_of;
using test::sum_of;

constexpr double density = 1500;

ParticleSet cloud(std::size_t n, double x0, double y0, double size, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit;
  ParticleSet p;
  p.grow(n);
  for (std::size_t i = 0; i < n; ++i) {
    p.x[i] = x0 + size * unit(random);
    p.y[i] = y0 + size * unit(random);
    p.vx[i] = 10 * unit(random), p.vy[i] = 4 * unit(random) - 2, p.vz[i] = -3 * unit(random);
    p.mass[i] = 900 + 200 * unit(random);
  }
  return p;
}

TEST(PeakMaps, KeepVolumeAtEveryRatioOfSpacingToCell) {
  const ParticleSet p = cloud(500, 200, 200, 100);
  const double mass = std::accumulate(p.mass.begin(), p.mass.end(), 0.0);
  for (double spacing : {1.0, 5.0, 7.0, 11.0, 23.0}) {
    const MemberResult r = maps_of({Grid{100, 100, 0, 500, 5, ""}, spacing, density, 0.01}, p);
    // Maps are floats: each cell rounds by 6e-8 of itself.
    EXPECT_NEAR(sum_of(r.layer(PeakLayer::deposit)) * 25, mass / density, 3e-8 * mass / density)
        << spacing;
    EXPECT_EQ(r.layer(PeakLayer::deposit), r.layer(PeakLayer::thickness));
  }
}

TEST(PeakMaps, KeepVolumeExactlyWhereFloatsCan) {
  // On cell centres and corners all weights and masses are short binary fractions.
  ParticleSet p;
  p.grow(600);
  for (int i = 0; i < 600; ++i) {
    p.x[i] = 100 + 2 * (i % 25), p.y[i] = 100 + 2 * (i / 25);
    p.mass[i] = 1024 * (1 + i % 3);
  }
  const MemberResult r = maps_of({Grid{100, 100, 0, 400, 4, ""}, 4, 1024, 0.01}, p);
  EXPECT_NEAR(sum_of(r.layer(PeakLayer::deposit)) * 16, 1200, 1e-12 * 1200);
  EXPECT_NEAR(sum_of(r.layer(PeakLayer::thickness)) * 16, 1200, 1e-12 * 1200);
}

TEST(PeakMaps, OneParticleIsSpreadByTheQuadraticBSpline) {
  ParticleSet p;
  p.grow(1);
  p.x[0] = 22.0, p.y[0] = 30.5, p.mass[0] = density;  // 0.4 cells west, 0.2 north of a centre
  const MemberResult r = maps_of({Grid{20, 20, 0, 60, 3, ""}, 1, density, 1e-9}, p);
  const double u = (22.0 - 22.5) / 3, v = (30.5 - 31.5) / 3;
  const auto weight = [](double t) {
    t = std::abs(t);
    return t < 0.5 ? 0.75 - t * t : t < 1.5 ? 0.5 * (1.5 - t) * (1.5 - t) : 0.0;
  };
  const int row = r.grid.row_of(31.5), col = r.grid.col_of(22.5);
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j) {
      const double exact = weight(u - j) * weight(v + i) / 9;
      EXPECT_NEAR(at(r, PeakLayer::deposit, row + i, col + j), exact, 1e-7 * exact + 1e-12);
    }
}

TEST(PeakMaps, MoveWithTheParticles) {
  const Grid g{80, 80, 0, 400, 5, ""};
  ParticleSet p = cloud(300, 100, 100, 50);
  for (double& x : p.x) x = std::round(x * 64) / 64;  // so that a shift by cells is exact
  for (double& y : p.y) y = std::round(y * 64) / 64;
  const MemberResult a = maps_of({g, 7, density, 0.05}, p);
  for (double& x : p.x) x += 20;
  for (double& y : p.y) y += 35;
  const MemberResult b = maps_of({g, 7, density, 0.05}, p);
  EXPECT_EQ(a.window.col0 + 4, b.window.col0);
  EXPECT_EQ(a.window.row0 - 7, b.window.row0);
  for (PeakLayer layer : {PeakLayer::thickness, PeakLayer::speed, PeakLayer::energy}) {
    ASSERT_EQ(a.layer(layer).size(), b.layer(layer).size());
    for (std::size_t k = 0; k < a.layer(layer).size(); ++k)
      ASSERT_NEAR(a.layer(layer)[k], b.layer(layer)[k], 1e-6 * std::abs(a.layer(layer)[k]) + 1e-9);
  }
}

TEST(PeakMaps, PlugFlowHasItsSpeedEnergyAndPressure) {
  const Grid g{60, 60, 0, 300, 5, ""};
  ParticleSet p;
  p.grow(std::size_t{40} * 40);
  for (int i = 0; i < 1600; ++i) {  // 2 m of flow on 100 x 100 m
    p.x[i] = 100 + 2.5 * (i % 40 + 0.5), p.y[i] = 100 + 2.5 * (i / 40 + 0.5);
    p.vx[i] = 6, p.vz[i] = -8;
    p.mass[i] = density * 2 * 2.5 * 2.5;
  }
  const MemberResult r = maps_of({g, 2.5, density, 0.1}, p);
  const int row = g.row_of(150), col = g.col_of(150);
  EXPECT_NEAR(at(r, PeakLayer::thickness, row, col), 2, 1e-6);
  EXPECT_NEAR(at(r, PeakLayer::speed, row, col), 10, 1e-5);
  EXPECT_NEAR(at(r, PeakLayer::energy, row, col), 0.5 * density * 2 * 100, 0.1);
  EXPECT_NEAR(at(r, PeakLayer::pressure, row, col), density * 100, 0.1);
  EXPECT_NEAR(r.scalars.max_pressure_pa, density * 100, 0.1);
  EXPECT_NEAR(r.scalars.reached_area_m2, 100 * 100, 2500);
  EXPECT_EQ(r.scalars.reached_area_m2, r.scalars.deposit_area_m2);
}

TEST(PeakMaps, TakeTheMaximumOfProductsNotTheProductOfMaxima) {
  // First thick and slow, then thin and fast, through the same cell.
  const Grid g{30, 30, 0, 150, 5, ""};
  ParticleSet slow = cloud(400, 60, 60, 30, 3), fast = slow;
  for (std::size_t i = 0; i < slow.size(); ++i) {
    slow.vx[i] = 2, slow.vy[i] = slow.vz[i] = 0;
    fast.vx[i] = 20, fast.vy[i] = fast.vz[i] = 0;
    fast.mass[i] *= 0.05;
  }
  test::OneSetMaps maps({g, 5, density, 1e-4});
  maps.record(slow, 1);
  maps.record(fast, 2);
  MemberResult r;
  maps.finish(fast, r);
  const int row = g.row_of(75), col = g.col_of(75);
  const double h = at(r, PeakLayer::thickness, row, col);
  EXPECT_NEAR(at(r, PeakLayer::speed, row, col), 20, 1e-4);
  // 0.5 rho h v^2 is 5 times larger in the second instant, and 20 times smaller than the product
  // of the separate maxima.
  EXPECT_NEAR(at(r, PeakLayer::energy, row, col), 0.5 * density * (0.05 * h) * 400, 1);
  EXPECT_NEAR(at(r, PeakLayer::deposit, row, col), 0.05 * h, 1e-6);
}

TEST(PeakMaps, ArrivalIsTheFirstInstantAboveTheLimit) {
  const Grid g{60, 30, 0, 150, 5, ""};
  test::OneSetMaps maps({g, 5, density, 0.05});
  ParticleSet p = cloud(300, 20, 60, 20);
  const int row = g.row_of(70);
  for (int t = 0; t < 20; ++t) {
    maps.record(p, t);
    for (double& x : p.x) x += 10;
  }
  for (double& x : p.x) x -= 10;
  MemberResult r;
  maps.finish(p, r);
  EXPECT_EQ(at(r, PeakLayer::arrival, row, g.col_of(30)), 0);
  const float near = at(r, PeakLayer::arrival, row, g.col_of(92.5));
  const float far = at(r, PeakLayer::arrival, row, g.col_of(192.5));
  EXPECT_NEAR(near, (92.5 - 45) / 10, 1.1);
  EXPECT_EQ(far - near, 10);
  EXPECT_TRUE(std::isnan(at(r, PeakLayer::arrival, row, g.col_of(290))));
  EXPECT_EQ(at(r, PeakLayer::deposit, row, g.col_of(30)), 0);
}

TEST(PeakMaps, ThinCellsKeepTheirThicknessButAreNotReached) {
  const Grid g{30, 30, 0, 150, 5, ""};
  ParticleSet p = cloud(50, 60, 60, 30);
  const MemberResult r = maps_of({g, 5, density, 1.0}, p);
  EXPECT_GT(r.scalars.max_thickness_m, 0.01);
  EXPECT_LT(r.scalars.max_thickness_m, 1.0);
  EXPECT_EQ(r.scalars.reached_area_m2, 0);
  EXPECT_EQ(sum_of(r.layer(PeakLayer::speed)), 0);
  for (float t : r.layer(PeakLayer::arrival)) ASSERT_TRUE(std::isnan(t));
}

TEST(PeakMaps, MassBeyondTheGridIsDroppedNotPushedIn) {
  const Grid g{20, 20, 0, 100, 5, ""};
  ParticleSet p;
  p.grow(3);
  p.x = {0.0, 50, 500}, p.y = {50, 50, 50};  // on the western edge, inside, far away
  p.mass = {density, density, density};
  const MemberResult r = maps_of({g, 5, density, 1e-6}, p);
  EXPECT_NEAR(sum_of(r.layer(PeakLayer::deposit)) * 25, 1.5, 1e-6);
  const double edge =
      at(r, PeakLayer::deposit, g.row_of(52.5), 0) + at(r, PeakLayer::deposit, g.row_of(47.5), 0);
  EXPECT_NEAR(edge, 0.5 / 25, 1e-7);
}

TEST(PeakMaps, TheWindowIsTightAndNothingMakesAnEmptyOne) {
  const Grid g{200, 100, 0, 500, 5, ""};
  ParticleSet p;
  p.grow(1);
  p.x[0] = 502.5, p.y[0] = 252.5, p.mass[0] = density;  // on a cell centre: 3 x 3 cells
  const MemberResult r = maps_of({g, 5, density, 1e-6}, p);
  EXPECT_EQ(r.window.n_rows, 3);
  EXPECT_EQ(r.window.n_cols, 3);
  EXPECT_EQ(r.window.col0, 99);
  EXPECT_EQ(r.window.row0, 48);
  EXPECT_EQ(r.layer(PeakLayer::arrival).size(), 9u);
  const MemberResult none = maps_of({g, 5, density, 1e-6}, ParticleSet{});
  EXPECT_EQ(none.window.n_cells(), 0u);
  EXPECT_EQ(none.scalars.max_thickness_m, 0);
}

TEST(PeakMaps, GrowWithoutForgettingAndRepeatBitwise) {
  const Grid g{400, 400, 0, 2000, 5, ""};
  const auto run = [&](bool backwards) {
    test::OneSetMaps maps({g, 7, density, 0.01});
    const ParticleSet here = cloud(200, 900, 900, 60), there = cloud(200, 1500, 300, 60, 2);
    maps.record(backwards ? there : here, 1);
    maps.record(backwards ? here : there, 1);
    MemberResult r;
    maps.finish(here, r);
    return r;
  };
  const MemberResult a = run(false), b = run(true);
  EXPECT_EQ(a.window.n_cells(), b.window.n_cells());
  EXPECT_EQ(a.layer(PeakLayer::thickness), b.layer(PeakLayer::thickness));
  EXPECT_EQ(a.layer(PeakLayer::pressure), b.layer(PeakLayer::pressure));
  EXPECT_GT(at(a, PeakLayer::thickness, g.row_of(930), g.col_of(930)), 0);
  EXPECT_GT(at(a, PeakLayer::thickness, g.row_of(330), g.col_of(1530)), 0);
}

TEST(PeakMaps, ParticlesWithoutAFinitePlaceAreLeftOut) {
  const Grid g{30, 30, 0, 150, 5, ""};
  ParticleSet p = cloud(100, 60, 60, 30);
  p.x[3] = nan_d, p.y[4] = 1e300, p.vx[5] = std::numeric_limits<double>::infinity();
  const MemberResult r = maps_of({g, 5, density, 0.01}, p);
  for (PeakLayer layer : {PeakLayer::thickness, PeakLayer::speed, PeakLayer::energy})
    for (float v : r.layer(layer)) ASSERT_TRUE(std::isfinite(v));
  EXPECT_GT(r.scalars.reached_area_m2, 0);
}

}  // namespace
}  // namespace sturz
