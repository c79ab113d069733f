// SPDX-License-Identifier: Apache-2.0
/// A release as depth-averaged columns: one on the bed per lattice cell, with all its mass.
#include "engine/core/sum.hpp"
#include "engine/particles/release.hpp"
#include "tests/support/formula_ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace sturz {
namespace {

using test::raster_of;

double slope(double x, double y) { return 300 - 0.6 * x + 0.2 * y; }
double mound(double x, double y) {
  return std::max(0.0, 20 * (1 - (std::pow(x - 250, 2) + std::pow(y - 250, 2)) / 3600));
}
const Grid ground_grid{100, 100, 0, 500, 5, ""};
Terrain bed() { return test::ground_of(slope, ground_grid); }

double total(const std::vector<double>& v) {
  Sum s;
  for (double x : v) s.add(x);
  return s.value();
}

ReleaseSettings columns(double spacing, double jitter = 0.05, std::int64_t member = 0) {
  return {spacing, 1500, jitter, 7, member, true};
}

TEST(ColumnRelease, PutsOneColumnOnTheBedPerLatticeCell) {
  const Terrain ground = bed();
  const auto thickness = raster_of(mound, ground_grid);
  const Release r = release_particles(ground, thickness, columns(3));
  std::set<std::pair<long, long>> cells;
  for (std::size_t i = 0; i < r.x.size(); ++i) {
    cells.insert({std::lround(std::floor(r.x[i] / 3)), std::lround(std::floor(r.y[i] / 3))});
    EXPECT_NEAR(r.z[i], slope(r.x[i], r.y[i]), 1e-9);
    EXPECT_NEAR(r.depth[i], 0.5 * r.thickness[i], 1e-12) << "its middle";
  }
  EXPECT_EQ(cells.size(), r.x.size());
  EXPECT_NEAR(r.x.size() * 9.0, r.area_m2, 0.05 * r.area_m2);
}

TEST(ColumnRelease, MassIsExactAtEverySpacing) {
  const Terrain ground = bed();
  for (const double shift : {0.0, 2.9}) {
    const auto thickness = raster_of(mound, Grid{30, 30, 175 + shift, 325 - shift, 5, ""});
    const double volume = total(thickness.values) * 25;
    for (const double dx : {2.0, 3.3, 7.0, 30.0}) {
      const Release r = release_particles(ground, thickness, columns(dx));
      EXPECT_NEAR(total(r.mass), 1500 * volume, 1e-12 * 1500 * volume);
      EXPECT_EQ(r.x.size(), r.mass.size());
      EXPECT_EQ(r.x.size(), r.thickness.size());
    }
  }
}

TEST(ColumnRelease, MassFollowsTheThicknessOfEachCell) {
  const Terrain ground = bed();
  Raster<double> thickness(Grid{4, 1, 200, 210, 10, ""}, 2.0);
  thickness.at(0, 3) = 6;
  const Release r = release_particles(ground, thickness, columns(10));
  ASSERT_EQ(r.x.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(r.mass[i], 1500 * 100 * r.thickness[i], 1e-6);
    EXPECT_NEAR(r.thickness[i], r.x[i] > 230 ? 6 : 2, 1e-12);
  }
}

TEST(ColumnRelease, DropsOnlyCellsUnderAHundredthOfTheMedian) {
  const Terrain ground = bed();
  // Median by volume: 10 m. A stack would drop all that is thinner than two metres.
  Raster<double> thickness(Grid{10, 10, 200, 300, 10, ""}, 10.0);
  for (int c = 0; c < 10; ++c) {
    thickness.at(0, c) = 0.1;     // exactly a hundredth stays
    thickness.at(1, c) = 0.0999;  // goes
    thickness.at(2, c) = 0.5;
    thickness.at(3, c) = c < 5 ? nan_d : 0;
  }
  const Release r = release_particles(ground, thickness, columns(10));
  EXPECT_NEAR(r.median_thickness_m, 10, 1e-12);
  EXPECT_EQ(r.x.size(), 80u);
  std::map<double, int> by_thickness;
  for (double h : r.thickness) ++by_thickness[std::round(h * 1e6) / 1e6];
  EXPECT_EQ(by_thickness[0.1], 10);
  EXPECT_EQ(by_thickness[0.5], 10);
  EXPECT_EQ(by_thickness[10], 60);
  const double all = 600 + 1 + 0.999 + 5;
  EXPECT_NEAR(r.dropped_fraction, 0.999 / all, 1e-12);
  EXPECT_NEAR(total(r.mass), 1500 * 100 * all, 1e-6) << "given to the others";
}

TEST(ColumnRelease, HasTheJitterOfTheStacksLowestParticles) {
  const Terrain ground = bed();
  const auto thickness = raster_of(mound, ground_grid);
  for (const std::int64_t member : {0, 3}) {
    const Release c = release_particles(ground, thickness, columns(3, 0.2, member));
    ReleaseSettings stacked = columns(3, 0.2, member);
    stacked.columns = false;
    const Release s = release_particles(ground, thickness, stacked);
    std::set<std::pair<double, double>> positions;
    for (std::size_t i = 0; i < s.x.size(); ++i) positions.insert({s.x[i], s.y[i]});
    // Stacks leave the thinnest edge out.
    std::size_t shared = 0, thick = 0;
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      shared += positions.count({c.x[i], c.y[i]});
      thick += c.thickness[i] >= 0.2 * 3;
    }
    EXPECT_EQ(shared, thick);
    EXPECT_GT(shared, 1000u);
  }
}

TEST(ColumnRelease, KeepsToItsLatticeWithoutJitterAndFollowsTheMemberWithIt) {
  const Terrain ground = bed();
  const auto thickness = raster_of(mound, ground_grid);
  const Release still = release_particles(ground, thickness, columns(3, 0));
  for (const double x : still.x) EXPECT_NEAR(std::remainder(x - 1.5, 3), 0, 1e-9);
  EXPECT_EQ(release_particles(ground, thickness, columns(3, 0.1, 4)).x,
            release_particles(ground, thickness, columns(3, 0.1, 4)).x);
  EXPECT_NE(release_particles(ground, thickness, columns(3, 0.1, 4)).x,
            release_particles(ground, thickness, columns(3, 0.1, 5)).x);
}

}  // namespace
}  // namespace sturz
