// SPDX-License-Identifier: Apache-2.0
// Probability maps of a front whose place is known at two levels, and distances to outlines.
#include "ensemble/fidelity/multilevel/multilevel_map.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/multilevel/residual_smoothing.hpp"
#include "ensemble/fidelity/multilevel/signed_distance.hpp"
#include "tests/ensemble/fidelity/multilevel/normal_draws.hpp"
#include "tests/support/front_members.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz::test {
namespace {

constexpr int n_rows = 5, n_cols = 60;

TEST(ASignedDistance, IsThatOfTheNearestCellOfTheOtherKind) {
  Grid grid = small_grid(13, 17);
  Raster<std::uint8_t> set(grid, 0);
  for (std::size_t i = 0; i < set.values.size(); ++i) set.values[i] = unit_random(4, i) < 0.2;
  const Raster<float> d = signed_distance(set);
  for (int r = 0; r < 13; ++r)
    for (int c = 0; c < 17; ++c) {
      double nearest = 1e9;
      for (int i = 0; i < 13; ++i)
        for (int j = 0; j < 17; ++j)
          if (set.at(i, j) != set.at(r, c)) nearest = std::min(nearest, std::hypot(i - r, j - c));
      const double expected = grid.cell_m * (nearest - 0.5) * (set.at(r, c) != 0 ? 1 : -1);
      EXPECT_NEAR(d.at(r, c), expected, 1e-3) << r << ", " << c;
    }
  EXPECT_FLOAT_EQ(signed_distance(Raster<std::uint8_t>(grid, 0)).at(3, 3),
                  static_cast<float>(-grid.cell_m * 30));
}

/// Fronts at 250 + 60 z + 8 e at the dear level, 350 + 80 z + 8 e at the cheap one, which is wrong
/// by far more than a cell.
struct Strip {
  MemoryMembers dear{small_grid(n_rows, n_cols)}, cheap{small_grid(n_rows, n_cols)};
  MapLevels levels;

  Strip(std::size_t n_dear, std::size_t n_cheap, std::uint64_t stream) {
    for (std::size_t k = 0; k < n_cheap; ++k) {
      const double z = normal(stream, k);
      const auto number = static_cast<std::int64_t>(k);
      if (k < n_dear)
        dear.add(front_member(number, 250 + 60 * z + 8 * normal(stream + 1, k), dear.grid()));
      cheap.add(front_member(number, 350 + 80 * z + 8 * normal(stream + 2, k), cheap.grid()));
      levels.draws.push_back({number, k < n_dear ? 0U : 1U, {}});
    }
    levels.levels = {&dear, &cheap};
    levels.spacings_m = {6, 12};
  }
  static double truth(int col, double thickness = 0) {
    return normal_share((250 - 100 * thickness - (10 * col + 5)) / std::hypot(60, 8));
  }
};

TEST(AMultilevelMap, HasTheDearestLevelsProbabilities) {
  constexpr int repeats = 60;
  constexpr std::size_t n_dear = 16;
  double bias = 0, squares = 0, plain = 0, predicted = 0, covered = 0, cells = 0, forecast = 0;
  for (int r = 0; r < repeats; ++r) {
    const Strip strip(n_dear, 400, 1000 + 10 * static_cast<std::uint64_t>(r));
    const MultilevelMap map = multilevel_map(strip.levels, {PeakLayer::thickness, 0}, CancelFlag());
    predicted += map.rms_error * map.rms_error / repeats;
    forecast += map.variances[0] / map.plain_variance / repeats;
    for (int col = 0; col < n_cols; ++col) {
      const double truth = Strip::truth(col);
      if (truth < 0.05 || truth > 0.95) continue;
      const std::size_t i = map.probability.grid.index(2, col - map.extent.col0);
      const double error = map.probability.values[i] - truth;
      bias += error;
      squares += error * error;
      plain += truth * (1 - truth) / n_dear;
      covered += map.low.values[i] <= truth && truth <= map.high.values[i] ? 1 : 0;
      cells += 1;
    }
  }
  EXPECT_NEAR(bias / cells, 0, 0.01);
  EXPECT_LT(squares, plain / 5);
  EXPECT_NEAR(std::sqrt(predicted / (squares / cells)), 1, 0.35);
  EXPECT_GE(covered / cells, 0.85);
  EXPECT_LT(forecast, 0.25);
}

TEST(AMultilevelMap, IsTheShareOfMembersFarFromAnyFront) {
  const Strip strip(12, 100, 5);
  const MultilevelMap map = multilevel_map(strip.levels, {PeakLayer::thickness, 0});
  EXPECT_EQ(map.probability.at(2, 0), 1);
  EXPECT_NEAR(map.probability.at(2, map.extent.n_cols - 1), 0, 1e-3);
  for (std::size_t i = 0; i < map.probability.values.size(); ++i) {
    EXPECT_GE(map.low.values[i], 0);
    EXPECT_LE(map.high.values[i], 1);
    EXPECT_LE(map.low.values[i], map.probability.values[i]);
    EXPECT_GE(map.high.values[i], map.probability.values[i]);
  }
}

/// Few of 16 draws come beyond 360 m. Bounds that trusted the scatter of the rest were lower where
/// one came as foretold than where none does, farther out.
TEST(AMultilevelMap, HasNoUpperBoundBelowThoseFartherOut) {
  constexpr int repeats = 20;
  double told_m = 0, cheap_m = 0;
  for (int r = 0; r < repeats; ++r) {
    const Strip strip(16, 400, 30000 + 10 * static_cast<std::uint64_t>(r));
    const MultilevelMap map = multilevel_map(strip.levels, {PeakLayer::thickness, 0});
    const int row = 2, cols = map.extent.n_cols;
    EXPECT_EQ(map.told.at(row, 0), 1) << r;
    // Beyond every front nothing is told, and up to there everything is.
    int last = 0, rises = 0;
    for (int col = 0; col < cols; ++col) {
      rises += col > 0 && map.told.at(row, col) > map.told.at(row, col - 1) ? 1 : 0;
      if (map.told.at(row, col) != 0) last = col;
      EXPECT_GE(map.high.at(row, col), unseen_share(16)) << r << ": " << col;
      EXPECT_LE(map.low.at(row, col), 1 - unseen_share(16)) << r << ": " << col;
      EXPECT_TRUE(map.told.at(row, col) != 0 || map.probability.at(row, col) == 0)
          << r << ": " << col;
    }
    EXPECT_EQ(rises, 0) << r;
    told_m += 10.0 * (last + map.extent.col0 + 1) / repeats;
    double farthest = 0;
    for (std::size_t k = 0; k < 400; ++k)
      farthest = std::max(farthest, 350 + 80 * normal(30000 + 10 * std::uint64_t(r), k));
    cheap_m += farthest / repeats;
  }
  // To where the fits move the farthest of 400 cheap fronts (three deviations: 430 m, and what ten
  // fits to some 14 draws differ by), not to where that lies itself (590 m).
  EXPECT_GT(told_m, 400);
  EXPECT_LT(told_m, cheap_m - 50);
}

TEST(AMultilevelMap, IsRefusedWhereItDoesNotFitMemory) {
  Strip strip(12, 100, 5);
  strip.levels.memory_bytes = 1000;
  EXPECT_THROW(multilevel_map(strip.levels, {PeakLayer::thickness, 0}), SetupError);
}

TEST(MultilevelMaps, FallWithTheThreshold) {
  const Strip strip(12, 100, 9);
  std::vector<MultilevelMap> maps;
  for (const float above : {0.0F, 0.02F, 0.04F, 1.0F})
    maps.push_back(multilevel_map(strip.levels, {PeakLayer::thickness, above}));
  const std::vector<MultilevelMap> before = maps;
  make_monotone(maps);
  std::size_t untold = 0;
  for (std::size_t i = 0; i < maps[0].told.values.size(); ++i)
    for (std::size_t t = 1; t < maps.size(); ++t) {
      EXPECT_LE(maps[t].told.values[i], maps[t - 1].told.values[i]);
      untold += maps[t].told.values[i] == 0 ? 1 : 0;
    }
  EXPECT_GT(untold, 0U);
  for (std::size_t i = 0; i < maps[0].probability.values.size(); ++i) {
    double sum = 0, sum_before = 0;
    for (std::size_t t = 0; t < maps.size(); ++t) {
      sum += maps[t].probability.values[i];
      sum_before += before[t].probability.values[i];
      if (t == 0) continue;
      EXPECT_LE(maps[t].probability.values[i], maps[t - 1].probability.values[i] + 1e-12);
      EXPECT_LE(maps[t].high.values[i], maps[t - 1].high.values[i] + 1e-12);
    }
    EXPECT_NEAR(sum, sum_before, 1e-9);  // the nearest falling row has the same mean
  }
}

/// A correction that is the same everywhere, under noise of each cell's own: the widest mean. Means
/// over 25 and over 49 cells have risks of 1/400 and 1/784, and their estimates from 400 cells
/// differ by 2 sqrt(1/16 (1/400 - 1/784) / 400) = 0.0009 by chance, three quarters of what they
/// differ by in truth: the widest is taken in most repeats, not in each.
TEST(ACorrection, IsSmoothedWhereThatLowersItsRisk) {
  constexpr int repeats = 40;
  const Grid grid = small_grid(20, 20);
  std::vector<std::size_t> places(grid.n_cells());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = i;
  const std::vector<std::uint8_t> all(places.size(), 1);
  int widest = 0;
  double ratio = 0;
  for (std::uint64_t r = 0; r < repeats; ++r) {
    std::vector<std::vector<float>> even(16, std::vector<float>(places.size())), steep = even;
    for (std::size_t k = 0; k < even.size(); ++k)
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double noise = normal(100 * r + k, i);
        even[k][i] = static_cast<float>(0.1 + noise);
        steep[k][i] = static_cast<float>((i % 2 == 0 ? 3 : -3) + noise);
      }
    const SmoothedCorrection wide = smoothed_correction(even, {}, places, grid, all, 3);
    widest += wide.radius == 3 ? 1 : 0;
    ratio += wide.variance_ratio / repeats;
    EXPECT_GT(wide.radius, 0) << r;
    EXPECT_NEAR(wide.mean[210], 0.1, 0.2) << r;  // four times the error of a mean over 25 cells
    EXPECT_EQ(smoothed_correction(steep, {}, places, grid, all, 3).radius, 0) << r;
  }
  EXPECT_GE(widest, repeats * 3 / 4);
  EXPECT_LT(ratio, 1.0 / 25);  // 1/49 where the widest is taken
}

}  // namespace
}  // namespace sturz::test
