// SPDX-License-Identifier: Apache-2.0
// Peak maps that tell grains and liquid apart.
#include "tests/support/peak_map_reading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace sturz {
namespace {

using test::at;

const Grid grid{60, 60, 0, 300, 5, ""};
constexpr double limit = 0.01, spacing = 5;
constexpr double grain_density = 2600, liquid_density = 1100, solid_fraction = 0.5;

/// Grains whose bulk is half pores, or the liquid between them.
MovingSet cloud(bool grains, std::size_t n, double x0, double size, double vx, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit;
  MovingSet p;
  p.grow(n);
  for (std::size_t i = 0; i < n; ++i) {
    p.x[i] = x0 + size * unit(random), p.y[i] = 100 + size * unit(random);
    p.vx[i] = vx, p.vy[i] = 1, p.vz[i] = -2;
    p.mass[i] = (grains ? grain_density : liquid_density) * solid_fraction * 125;
  }
  p.spacing = spacing;
  p.bulk_density = grains ? grain_density * solid_fraction : liquid_density;
  if (grains) p.filled_share = solid_fraction;
  return p;
}

std::vector<MovingSet> both(double grain_speed, double liquid_speed) {
  return {cloud(true, 300, 100, 60, grain_speed, 1), cloud(false, 300, 130, 60, liquid_speed, 2)};
}

MemberResult maps_of(const std::vector<MovingSet>& sets, bool by_set) {
  PeakMaps maps({grid, limit, 0.375, by_set});
  maps.record(sets, 3);
  MemberResult r;
  maps.finish(sets, r);
  return r;
}

template <class Check>
void for_cells(const Check& check) {
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col) check(row, col);
}

TEST(PeakMapsOfMaterials, AreThoseOfEachAlone) {
  const std::vector<MovingSet> sets = both(12, 20);
  const MemberResult r = maps_of(sets, true);
  const MemberResult grains = maps_of({sets[0]}, false), liquid = maps_of({sets[1]}, false);
  using L = PeakLayer;
  const std::pair<L, std::pair<L, L>> pairs[] = {
      {L::thickness, {L::solid, L::liquid}},
      {L::speed, {L::solid_speed, L::liquid_speed}},
      {L::energy, {L::solid_energy, L::liquid_energy}},
      {L::arrival, {L::solid_arrival, L::liquid_arrival}}};
  int compared = 0;
  for_cells([&](int row, int col) {
    for (const auto& [alone, own] : pairs) {
      const float g = at(grains, alone, row, col), l = at(liquid, alone, row, col);
      ASSERT_TRUE(at(r, own.first, row, col) == g || std::isnan(g)) << row << " " << col;
      ASSERT_TRUE(at(r, own.second, row, col) == l || std::isnan(l)) << row << " " << col;
      ASSERT_EQ(std::isnan(at(r, own.first, row, col)), std::isnan(g));
      ASSERT_EQ(std::isnan(at(r, own.second, row, col)), std::isnan(l));
      compared += g > 0;
    }
  });
  EXPECT_GT(compared, 400);
}

/// rho v^2 of both together is the sum of what either pushes with, and so is the energy.
TEST(PeakMapsOfMaterials, SharePressureAndEnergyWhereTheyMoveAsOne) {
  const MemberResult r = maps_of(both(15, 15), true);
  int mixed = 0;
  for_cells([&](int row, int col) {
    const auto value = [&](PeakLayer layer) { return at(r, layer, row, col); };
    if (!(value(PeakLayer::solid) > limit && value(PeakLayer::liquid) > limit)) return;
    ++mixed;
    ASSERT_NEAR(value(PeakLayer::solid_pressure) + value(PeakLayer::liquid_pressure),
                value(PeakLayer::pressure), 1e-5 * value(PeakLayer::pressure));
    ASSERT_NEAR(value(PeakLayer::solid_energy) + value(PeakLayer::liquid_energy),
                value(PeakLayer::energy), 1e-5 * value(PeakLayer::energy));
    ASSERT_NEAR(value(PeakLayer::solid) + value(PeakLayer::liquid), value(PeakLayer::thickness),
                1e-5 * value(PeakLayer::thickness));
  });
  EXPECT_GT(mixed, 20);
}

TEST(PeakMapsOfMaterials, ACellOfLiquidAloneHasNoGrains) {
  const MemberResult r = maps_of(both(12, 20), true);
  int liquid_alone = 0, grains_alone = 0;
  for_cells([&](int row, int col) {
    const float solid = at(r, PeakLayer::solid, row, col), wet = at(r, PeakLayer::liquid, row, col);
    const float share = at(r, PeakLayer::liquid_fraction, row, col);
    if (std::isnan(at(r, PeakLayer::arrival, row, col))) {
      ASSERT_TRUE(std::isnan(share)) << "nothing came, so it is of nothing";
    } else if (solid == 0) {
      ++liquid_alone;
      ASSERT_EQ(share, 1);
      ASSERT_TRUE(std::isnan(at(r, PeakLayer::solid_arrival, row, col)));
      ASSERT_EQ(at(r, PeakLayer::solid_pressure, row, col), 0);
      ASSERT_EQ(at(r, PeakLayer::liquid_pressure, row, col), at(r, PeakLayer::pressure, row, col));
    } else if (wet == 0) {
      ++grains_alone;
      ASSERT_EQ(share, 0);
    }
  });
  EXPECT_GT(liquid_alone, 20);
  EXPECT_GT(grains_alone, 20);
}

/// Water passes first, then a thick mixture that is two thirds grains, then water again.
TEST(PeakMapsOfMaterials, TheShareOfLiquidIsThatOfTheThickestInstant) {
  MovingSet grains = cloud(true, 40, 150, 0, 5, 1), liquid = cloud(false, 40, 150, 0, 5, 1);
  PeakMaps maps({grid, limit, 0.375, true});
  const auto instant = [&](double grains_m3, double liquid_m3, double time_s) {
    for (double& m : grains.mass) m = grain_density * grains_m3;
    for (double& m : liquid.mass) m = liquid_density * liquid_m3;
    maps.record(std::vector{grains, liquid}, time_s);
  };
  instant(0, 10, 0);
  instant(20, 10, 1);
  instant(1, 12, 2);
  MemberResult r;
  maps.finish(std::vector{grains, liquid}, r);
  const int row = grid.row_of(100), col = grid.col_of(150);
  EXPECT_NEAR(at(r, PeakLayer::liquid_fraction, row, col), 1.0 / 3, 1e-5);
  EXPECT_EQ(at(r, PeakLayer::liquid_arrival, row, col), 0);
  EXPECT_EQ(at(r, PeakLayer::solid_arrival, row, col), 1);
}

TEST(PeakMapsOfMaterials, AreNotThereWhereNobodyAsks) {
  const MemberResult r = maps_of(both(12, 20), false);
  for (int k = 0; k < n_peak_layers; ++k)
    EXPECT_EQ(r.layers[static_cast<std::size_t>(k)].empty(),
              is_of_materials(static_cast<PeakLayer>(k)) || k == static_cast<int>(PeakLayer::left))
        << k;
}

}  // namespace
}  // namespace sturz
