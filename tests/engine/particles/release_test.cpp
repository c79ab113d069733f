// SPDX-License-Identifier: Apache-2.0
#include "engine/particles/release.hpp"

#include "engine/core/error.hpp"
#include "engine/core/hash.hpp"
#include "engine/core/random.hpp"
#include "engine/core/sum.hpp"
#include "tests/support/formula_ground.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string_view>

namespace sturz {
namespace {

using test::Height;
using test::raster_of;

Terrain bed_of(const Height& f) { return test::ground_of(f, Grid{100, 100, 0, 500, 5, ""}); }

double total(const std::vector<double>& v) {
  Sum s;
  for (double x : v) s.add(x);
  return s.value();
}

double slope(double x, double y) { return 300 - 0.6 * x + 0.2 * y; }

double mound(double x, double y) {
  return std::max(0.0, 20 * (1 - (std::pow(x - 250, 2) + std::pow(y - 250, 2)) / 3600));
}

TEST(Release, MassIsExactOnShiftedRastersOfAnyCellSize) {
  const Terrain bed = bed_of(slope);
  for (double cell : {1.7, 5.0, 13.0})
    for (double shift : {0.0, 0.37, 2.9}) {
      const Grid g{static_cast<int>(150 / cell),
                   static_cast<int>(150 / cell),
                   175 + shift,
                   325 - shift / 3,
                   cell,
                   ""};
      const auto thickness = raster_of(mound, g);
      const double volume = total(thickness.values) * cell * cell;
      for (double dx : {2.0, 3.3, 7.0}) {
        const Release r = release_particles(bed, thickness, {dx, 1500, 0.05, 1, 0});
        EXPECT_NEAR(r.volume_m3, volume, 1e-12 * volume);
        EXPECT_NEAR(total(r.mass), 1500 * volume, 1e-12 * 1500 * volume);
        EXPECT_LT(r.dropped_fraction, 0.02);
        EXPECT_EQ(r.x.size(), r.depth.size());
      }
    }
}

TEST(Release, ColumnsCarryTheAreaWeightedMeanThickness) {
  // One cell of 4 x 4 m over columns of 3 m.
  const Terrain bed = bed_of([](double, double) { return 0.0; });
  Raster<double> thickness(Grid{1, 1, 100, 104, 4, ""}, 9.0);
  const Release r = release_particles(bed, thickness, {3, 1000, 0, 1, 0});
  std::map<std::pair<double, double>, double> volume;
  for (std::size_t i = 0; i < r.x.size(); ++i) volume[{r.x[i], r.y[i]}] += r.mass[i] / 1000;
  // Columns meet at 102 in x and at 102 in y: 2 x 2 m fall on each.
  ASSERT_EQ(volume.size(), 4u);
  for (double x : {100.5, 103.5})
    for (double y : {100.5, 103.5}) EXPECT_NEAR((volume[{x, y}]), 9 * 2 * 2, 1e-9);
  thickness.grid.west_m += 1;  // now 101..102 and 102..105
  volume.clear();
  const Release moved = release_particles(bed, thickness, {3, 1000, 0, 1, 0});
  for (std::size_t i = 0; i < moved.x.size(); ++i)
    volume[{moved.x[i], moved.y[i]}] += moved.mass[i] / 1000;
  EXPECT_NEAR((volume[{100.5, 103.5}]), 9 * 1 * 2, 1e-9);
  EXPECT_NEAR((volume[{103.5, 103.5}]), 9 * 3 * 2, 1e-9);
}

TEST(Release, NumberOfParticlesFollowsTheVolume) {
  const Terrain bed = bed_of(slope);
  const auto thickness = raster_of(
      [](double x, double y) {
        return std::abs(x - 250) < 60 && std::abs(y - 250) < 60 ? 12.0 : 0.0;
      },
      Grid{100, 100, 0, 500, 5, ""});
  for (double dx : {1.5, 2.0, 4.0}) {
    const Release r = release_particles(bed, thickness, {dx, 1, 0.05, 1, 0});
    EXPECT_NEAR(r.x.size() * dx * dx * dx, r.volume_m3, 0.04 * r.volume_m3) << dx;
    EXPECT_NEAR(r.layers, 12 / dx, 1e-9);
    EXPECT_NEAR(r.median_thickness_m, 12, 1e-9);
    EXPECT_EQ(r.max_thickness_m, 12);
    EXPECT_EQ(r.area_m2, 120 * 120);
  }
}

TEST(Release, NoParticleStartsWithinTheContactDistance) {
  const Terrain steep =
      bed_of([](double x, double y) { return -1.2 * x + 6 * std::sin(x / 9) * std::cos(y / 7); });
  const auto thickness = raster_of(mound, Grid{100, 100, 0, 500, 5, ""});
  for (double jitter : {0.0, 0.05, 0.3}) {
    const Release r = release_particles(steep, thickness, {4, 1500, jitter, 1, 0});
    double least = 1e9;
    for (std::size_t i = 0; i < r.x.size(); ++i) {
      least = std::min(least, steep.distance({r.x[i], r.y[i], r.z[i]}, 2).distance);
      ASSERT_GE(r.depth[i], 0);
    }
    EXPECT_GE(least, 2 * (1 - 1e-9)) << jitter;
    EXPECT_LT(least, 2.6);
  }
}

TEST(Release, StacksStandBetweenBedAndSurface) {
  const Terrain bed = bed_of([](double, double) { return 40.0; });
  Raster<double> thickness(Grid{10, 10, 200, 300, 5, ""}, 11.0);
  const Release r = release_particles(bed, thickness, {5, 1, 0, 1, 0});  // 2 layers of 5.5 m
  ASSERT_EQ(r.x.size(), 200u);
  for (std::size_t i = 0; i < r.x.size(); i += 2) {
    EXPECT_EQ(r.x[i], r.x[i + 1]);
    EXPECT_NEAR(r.z[i], 40 + 2.75, 1e-12);
    EXPECT_NEAR(r.z[i + 1], 40 + 8.25, 1e-12);
    EXPECT_NEAR(r.depth[i], 8.25, 1e-12);
  }
  // Thinner than a spacing: at contact distance, one particle with all the mass.
  Raster<double> sheet(Grid{10, 10, 200, 300, 5, ""}, 1.5);
  const Release s = release_particles(bed, sheet, {5, 1, 0, 1, 0});
  ASSERT_EQ(s.x.size(), 100u);
  EXPECT_NEAR(s.z[0], 42.5, 1e-12);
  EXPECT_EQ(s.depth[0], 0);
  EXPECT_NEAR(s.mass[0], 1.5 * 25, 1e-12);
}

TEST(Release, DoesNotDependOnTheExtentOfItsRaster) {
  const Terrain bed = bed_of(slope);
  const Release small =
      release_particles(bed, raster_of(mound, Grid{30, 30, 175, 325, 5, ""}), {3, 1, 0.05, 7, 12});
  const Release large =
      release_particles(bed, raster_of(mound, Grid{60, 70, 100, 450, 5, ""}), {3, 1, 0.05, 7, 12});
  EXPECT_EQ(small.x, large.x);
  EXPECT_EQ(small.z, large.z);
  EXPECT_EQ(small.mass, large.mass);
}

TEST(Release, JitterIsBoundedAndFollowsSeedAndMember) {
  const Terrain bed = bed_of(slope);
  const auto thickness = raster_of(mound, Grid{30, 30, 175, 325, 5, ""});
  const Release still = release_particles(bed, thickness, {3, 1, 0, 1, 0});
  const Release a = release_particles(bed, thickness, {3, 1, 0.1, 1, 0});
  const Release again = release_particles(bed, thickness, {3, 1, 0.1, 1, 0});
  const Release other_member = release_particles(bed, thickness, {3, 1, 0.1, 1, 1});
  const Release other_seed = release_particles(bed, thickness, {3, 1, 0.1, 2, 0});
  EXPECT_EQ(a.x, again.x);
  EXPECT_EQ(a.z, again.z);
  EXPECT_NE(a.x, other_member.x);
  EXPECT_NE(a.x, other_seed.x);
  ASSERT_EQ(a.x.size(), still.x.size());
  double widest = 0, mean = 0;
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    widest = std::max({widest, std::abs(a.x[i] - still.x[i]), std::abs(a.y[i] - still.y[i])});
    mean += (a.x[i] - still.x[i]) / static_cast<double>(a.x.size());
  }
  EXPECT_LE(widest, 0.3);
  EXPECT_GT(widest, 0.29);
  EXPECT_NEAR(mean, 0, 0.01);
}

TEST(Release, LayersAreTheMedianByVolumeNotByArea) {
  const Terrain bed = bed_of([](double, double) { return 0.0; });
  // 300 m2 of 2 m (600 m3) beside 100 m2 of 10 m (1000 m3): half the volume is in the thick part.
  Raster<double> thickness(Grid{4, 1, 200, 210, 10, ""}, 2.0);
  thickness.at(0, 3) = 10;
  const Release r = release_particles(bed, thickness, {2, 1, 0.05, 1, 0});
  EXPECT_NEAR(r.layers, 5, 1e-12);
}

TEST(Release, ThinColumnsGiveTheirMassToTheOthers) {
  const Terrain bed = bed_of([](double, double) { return 0.0; });
  Raster<double> thickness(Grid{10, 10, 200, 300, 10, ""}, 0.5);
  for (int i = 0; i < 10; ++i) thickness.at(i, 4) = 10;
  thickness.at(0, 0) = nan_d;
  thickness.at(0, 1) = -9999;
  const Release r = release_particles(bed, thickness, {10, 1000, 0.05, 1, 0});
  const double volume = 100 * (10 * 10 + 88 * 0.5);
  EXPECT_EQ(r.x.size(), 10u);
  EXPECT_NEAR(total(r.mass), 1000 * volume, 1e-12 * 1000 * volume);
  EXPECT_NEAR(r.dropped_fraction, 88 * 0.5 / 144, 1e-12);
}

TEST(Release, RefusesWhatCannotBecomeParticles) {
  const Terrain bed = bed_of(slope);
  const ReleaseSettings settings{5, 1500, 0.05, 1, 0};
  const Grid g{10, 10, 200, 300, 5, ""};
  const auto message = [&](const Raster<double>& thickness, ReleaseSettings s) -> std::string {
    try {
      release_particles(bed, thickness, s);
    } catch (const SetupError& e) {
      return e.what();
    }
    return "accepted";
  };
  using testing::HasSubstr;
  EXPECT_THAT(message(Raster<double>(g, 0.0), settings), HasSubstr("no mass"));
  EXPECT_THAT(message(Raster<double>(g, nan_d), settings), HasSubstr("no mass"));
  EXPECT_THAT(message(Raster<double>(g, 0.9), settings), HasSubstr("spacing_m"));
  EXPECT_THAT(message(Raster<double>({10, 10, -200, 300, 5, ""}, 9.0), settings),
              HasSubstr("outside the known terrain"));
  EXPECT_THAT(message(Raster<double>(g, 9.0), {1e-4, 1500, 0.05, 1, 0}), HasSubstr("metres"));
  Raster<double> infinite(g, 9.0);
  infinite.at(3, 3) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(message(infinite, settings), HasSubstr("infinite"));
}

TEST(Random, PhiloxGivesThePublishedWords) {
  // Known answers of philox4x32-10 (Salmon et al. 2011, kat_vectors).
  EXPECT_EQ(random_words(0, {0, 0, 0, 0}),
            (RandomWords{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(random_words(~0ull, {~0u, ~0u, ~0u, ~0u}),
            (RandomWords{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(random_words(0x299f31d0a4093822ull, {0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}),
            (RandomWords{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Release, UpperColumnsStandOnWhatLiesThereAndFillTheirHeight) {
  const Terrain bed = bed_of([](double, double) { return 10.0; });
  const ReleaseSettings s{2, 1000, 0, 1, 0};
  // Eight metres on six; a cell that is covered by a quarter, as high by lighter particles.
  const std::vector<UpperColumn> columns{{{50, 50, 8, 1}, 6, 3}, {{51, 50, 2, 0.25}, 0, 0}};
  const Release r = fill_columns(bed, columns, s, 10 * 4);
  ASSERT_EQ(r.x.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    const double above = i < 4 ? 6 : 0;
    EXPECT_NEAR(r.z[i], 10 + above + 2 * static_cast<double>(i % 4) + 1, 1e-12);
    EXPECT_NEAR(r.mass[i], i < 4 ? 8000 : 2000, 1e-9);
    EXPECT_NEAR(r.depth[i], 7 - 2 * static_cast<double>(i % 4), 1e-12);
    EXPECT_EQ(r.thickness[i], 8);
  }
  // Its jitter is not that of the layers under it.
  ReleaseSettings jittered = s;
  jittered.jitter = 0.1;
  std::vector<UpperColumn> lowest{columns[0]};
  const double third = fill_columns(bed, lowest, jittered, 32).x[0];
  lowest[0].first_layer = 0;
  EXPECT_NE(third, fill_columns(bed, lowest, jittered, 32).x[0]);
  EXPECT_EQ(third, fill_columns(bed, lowest, jittered, 32).x[3]);
}

TEST(Random, UnitNumbersFillTheOpenInterval) {
  double mean = 0, square = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double u = unit_random(42, i, 3);
    ASSERT_GT(u, 0);
    ASSERT_LT(u, 1);
    mean += u / n;
    square += u * u / n;
  }
  EXPECT_NEAR(mean, 0.5, 0.008);
  EXPECT_NEAR(square, 1.0 / 3, 0.008);
  EXPECT_GT(unit_from(0), 0);
  EXPECT_LT(unit_from(~0u), 1);
}

TEST(Hash, IsFnv1aOfTheBytes) {
  const auto of = [](std::string_view text) { return hash_of(std::span<const char>(text)); };
  EXPECT_EQ(of(""), 0xcbf29ce484222325u);
  EXPECT_EQ(of("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(of("foobar"), 0x85944171f73967e8u);
  const std::vector<double> v{1, 2, 3};
  const std::span<const double> s(v);
  EXPECT_EQ(Hash64{}.add(s.first(1)).add(s.subspan(1)).value(), hash_of(s));
  EXPECT_NE(Hash64{}.add(0.0).value(), Hash64{}.add(-0.0).value());
}

}  // namespace
}  // namespace sturz
