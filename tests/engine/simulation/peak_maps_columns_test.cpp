// SPDX-License-Identifier: Apache-2.0
/// Maps of depth-averaged columns, which bring their own widths; and layers across the thickness.
#include "engine/effects/fields.hpp"
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
const Grid grid{120, 100, 0, 500, 5, ""};

/// Columns at rest, with a support radius each.
struct Columns {
  ParticleSet set;

  Columns() { set.add(fields::support_radius); }
  void add(double x, double y, double volume, double support_radius) {
    set.grow(1);
    set.x.back() = x, set.y.back() = y, set.mass.back() = density * volume;
    set.scalar(fields::support_radius).back() = support_radius;
  }
};

Columns random_columns(int n, double least, double most, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit;
  Columns c;
  for (int k = 0; k < n; ++k) {
    const double x = 150 + 300 * unit(random), y = 150 + 200 * unit(random);
    c.add(x, y, 1 + unit(random), least + (most - least) * unit(random));
  }
  return c;
}

/// The same place and mass, spread over a width that all particles share.
MemberResult particle_of_width(double x, double y, double volume, double width) {
  ParticleSet p;
  p.grow(1);
  p.x[0] = x, p.y[0] = y, p.mass[0] = density * volume;
  return maps_of({grid, width, density, 1e-6}, p);
}

MemberResult column_of_radius(double x, double y, double volume, double support_radius) {
  Columns c;
  c.add(x, y, volume, support_radius);
  // The spacing does not count: columns stretch and crowd.
  return maps_of({grid, 1, density, 1e-6}, c.set);
}

void expect_same_maps(const MemberResult& a, const MemberResult& b) {
  ASSERT_EQ(a.window.n_rows, b.window.n_rows);
  ASSERT_EQ(a.window.n_cols, b.window.n_cols);
  for (PeakLayer layer : {PeakLayer::thickness, PeakLayer::deposit}) {
    const auto &va = a.layer(layer), &vb = b.layer(layer);
    for (std::size_t k = 0; k < va.size(); ++k) EXPECT_NEAR(va[k], vb[k], 1e-6 * (1 + vb[k]));
  }
}

TEST(ColumnMaps, AFootprintFollowsItsSupportRadius) {
  for (const double support_radius : {20.0, 28.0, 47.3, 90.0, 160.0})
    expect_same_maps(
        column_of_radius(301.7, 252.2, 800, support_radius),
        particle_of_width(301.7, 252.2, 800, PeakMapSettings{}.width_per_radius * support_radius));
}

TEST(ColumnMaps, AFootprintIsAtLeastACellWide) {
  const MemberResult cell = particle_of_width(301.7, 252.2, 800, 5);
  for (const double support_radius : {0.1, 4.0, 13.3})
    expect_same_maps(column_of_radius(301.7, 252.2, 800, support_radius), cell);
}

TEST(ColumnMaps, EachColumnHasItsOwnWidth) {
  Columns both;
  both.add(152.5, 252.5, 300, 80);
  both.add(450, 251, 500, 24);
  const MemberResult r = maps_of({grid, 1, density, 1e-6}, both.set);
  const MemberResult wide = column_of_radius(152.5, 252.5, 300, 80);
  const MemberResult narrow = column_of_radius(450, 251, 500, 24);
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col)
      EXPECT_EQ(at(r, PeakLayer::deposit, row, col),
                at(wide, PeakLayer::deposit, row, col) + at(narrow, PeakLayer::deposit, row, col));
}

double volume_of(const ParticleSet& p) {
  return std::accumulate(p.mass.begin(), p.mass.end(), 0.0) / density;
}

TEST(ColumnMaps, KeepVolumeWhateverTheSupportRadii) {
  for (const auto& [least, most] : {std::pair(1.0, 10.0), {16.0, 16.0}, {10.0, 200.0}}) {
    const Columns c = random_columns(400, least, most);
    const MemberResult r = maps_of({grid, 3, density, 1e-3}, c.set);
    // Maps are floats: each cell rounds by 6e-8 of itself.
    EXPECT_NEAR(sum_of(r.layer(PeakLayer::deposit)) * 25, volume_of(c.set),
                3e-8 * volume_of(c.set));
    EXPECT_EQ(r.layer(PeakLayer::deposit), r.layer(PeakLayer::thickness));
  }
}

TEST(ColumnMaps, FollowSupportRadiiThatGrowAndShrink) {
  Columns c = random_columns(200, 20, 20);
  auto& support_radius = c.set.scalar(fields::support_radius);
  test::OneSetMaps maps({grid, 1, density, 1e-3});
  for (const double now : {20.0, 110.0, 6.0, 61.0}) {
    std::fill(support_radius.begin(), support_radius.end(), now);
    maps.record(c.set, now);
  }
  MemberResult r, narrow;
  maps.finish(c.set, r);
  EXPECT_NEAR(sum_of(r.layer(PeakLayer::deposit)) * 25, volume_of(c.set), 3e-8 * volume_of(c.set));
  std::fill(support_radius.begin(), support_radius.end(), 6.0);
  narrow = maps_of({grid, 1, density, 1e-3}, c.set);
  EXPECT_GE(r.scalars.max_thickness_m, narrow.scalars.max_thickness_m) << "narrowest is thickest";
  // Widths that jump from one look to the next: the parabola through three adds an eighth at most.
  EXPECT_LE(r.scalars.max_thickness_m, 1.125001 * narrow.scalars.max_thickness_m);
  EXPECT_LT(r.scalars.max_deposit_m, narrow.scalars.max_deposit_m);
  // Where the narrowest comes last there is no parabola over it, and the peak is it to the bit.
  test::OneSetMaps shrinking({grid, 1, density, 1e-3});
  double time_s = 0;
  for (const double now : {20.0, 110.0, 61.0, 6.0}) {
    std::fill(support_radius.begin(), support_radius.end(), now);
    shrinking.record(c.set, time_s += 1);
  }
  shrinking.finish(c.set, r);
  EXPECT_EQ(r.scalars.max_thickness_m, narrow.scalars.max_thickness_m);
}

/// Widths of whole thirds of a cell, give or take the last bit: the number of cells that a column
/// touches hangs on how its width is rounded, and must not exceed the room for its weights
/// (sanitizers see that).
TEST(ColumnMaps, WidthsThatJustTouchOneMoreCellStayInTheirRoom) {
  for (const double cell : {0.3, 5.0, 7.0})
    for (int thirds = 4; thirds < 24; ++thirds)
      for (const double beside : {-1e9, 0.0, 1e9}) {
        const double support_radius = std::nextafter(4 * cell * thirds / 3, beside);
        const Grid g{60, 60, 0, 60 * cell, cell, ""};
        Columns c;
        c.add(29.8 * cell, 31.3 * cell, 10, support_radius);
        const MemberResult r = maps_of({g, 1, density, 1e-6}, c.set);
        EXPECT_NEAR(sum_of(r.layer(PeakLayer::deposit)) * cell * cell, 10, 1e-6);
      }
}

/// n x n particles of 1 m spacing on the centres of cells of 1 m: `layers` thick but at its edge.
test::OneSetMaps plate(int n, double layers) {
  ParticleSet p;
  p.grow(static_cast<std::size_t>(n) * n);
  for (int i = 0; i < n * n; ++i)
    p.x[i] = 10.5 + i % n, p.y[i] = 10.5 + i / n, p.mass[i] = density * layers;
  test::OneSetMaps maps({Grid{n + 20, n + 20, 0, n + 20.0, 1, ""}, 1, density, 1e-6});
  maps.record(p, 0);
  return maps;
}

TEST(LayerCount, AnEvenPlateHasItsLayers) {
  for (const double layers : {0.5, 3.0, 4.0, 17.0, 300.0}) {
    const LayerCount c = plate(60, layers).layers();
    EXPECT_NEAR(c.median / layers, 1, 0.051) << layers;  // 24 bins per decade: 10^(1/48)
    EXPECT_NEAR(c.p10 / layers, 1, 0.051) << layers;
  }
}

TEST(LayerCount, ExactlyFourLayersAreNotThin) {
  // The edge's cells carry 7/8 and 1/8 of four layers: they are thin.
  const double edge = 1 - 58.0 * 58 / (60 * 60);
  EXPECT_NEAR(plate(60, 4).layers().thin_fraction, edge, 1e-12);
  EXPECT_NEAR(plate(60, 3.999).layers().thin_fraction, 1, 1e-12);
  EXPECT_LT(plate(60, 300).layers().thin_fraction, 1e-12);
}

TEST(LayerCount, WeighsByMass) {
  // One particle on a cell's centre: 9/16 of it in that cell, 3/32 in each side, 1/64 in each
  // corner; 16 layers in the middle are 8/3 at the sides and 4/9 in the corners.
  ParticleSet p;
  p.grow(1);
  // 28.5 instead of 256/9: cells sum in float, which holds this mass and its parts to the last bit.
  p.x[0] = 10.5, p.y[0] = 10.5, p.mass[0] = density * 28.5;
  test::OneSetMaps maps({Grid{20, 20, 0, 20, 1, ""}, 1, density, 1e-6});
  maps.record(p, 0);
  const LayerCount c = maps.layers();
  EXPECT_NEAR(c.thin_fraction, 7.0 / 16, 1e-12);
  EXPECT_NEAR(c.median / 16, 1, 0.051);
  EXPECT_NEAR(c.p10 / (8.0 / 3), 1, 0.051) << "the corners hold 1/16, the sides the next 3/8";
}

TEST(LayerCount, IsThatOfTheLastInstant) {
  test::OneSetMaps maps = plate(40, 20);
  ParticleSet p;
  p.grow(1);
  p.x[0] = 20.5, p.y[0] = 20.5, p.mass[0] = density;
  maps.record(p, 1);
  EXPECT_EQ(maps.layers().thin_fraction, 1);
  EXPECT_NEAR(maps.layers().median / (9.0 / 16), 1, 0.051);
  EXPECT_EQ(test::OneSetMaps({grid, 1, density, 1e-6}).layers().median, 0) << "nothing yet";
}

}  // namespace
}  // namespace sturz
