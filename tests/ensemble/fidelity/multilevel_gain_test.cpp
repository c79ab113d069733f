// SPDX-License-Identifier: Apache-2.0
// Gains of cheap members on families of normal variables with known correlations.
#include "ensemble/fidelity/multilevel_gain.hpp"

#include "engine/core/random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sturz {
namespace {

using ::testing::ElementsAre;

double normal(std::uint64_t stream, std::uint64_t i) {
  return std::sqrt(-2 * std::log(unit_random(stream, i, 0))) *
         std::cos(2 * std::numbers::pi * unit_random(stream, i, 1));
}

/// Level l correlates rho[l] with the first one.
LevelValues family(const std::vector<double>& rho, std::size_t n, std::uint64_t stream = 1) {
  LevelValues r{"x", std::vector<std::vector<double>>(rho.size()), 1};
  for (std::size_t i = 0; i < n; ++i) {
    const double x = normal(stream, i);
    for (std::size_t l = 0; l < rho.size(); ++l)
      r.values[l].push_back(
          3 + static_cast<double>(l) +
          (1 + static_cast<double>(l)) *
              (rho[l] * x + std::sqrt(1 - rho[l] * rho[l]) * normal(stream + 100 + l, i)));
  }
  return r;
}

TEST(MultilevelGain, OfOneControlIsTheClosedForm) {
  const std::vector<double> cost{8, 0.1};
  const std::vector<LevelValues> results{family({1, 0.97}, 40000)};
  EXPECT_NEAR(squared_correlation(results[0], 1), 0.97 * 0.97, 2e-3);
  const MultilevelGain gain = multilevel_gain(results, cost, 1);
  const double r2 = squared_correlation(results[0], 1);
  EXPECT_THAT(gain.levels, ElementsAre(0U, 1U));
  EXPECT_NEAR(gain.gain, 8 / std::pow(std::sqrt(8 * (1 - r2)) + std::sqrt(0.1 * r2), 2), 1e-9);
  EXPECT_NEAR(gain.members[1], std::sqrt(8 * r2 / (0.1 * (1 - r2))), 1e-9);
  EXPECT_LT(gain.gain_90.low, gain.gain);
  EXPECT_GT(gain.gain_90.high, gain.gain);
}

/// The variance that such members really have, beside the prediction.
TEST(MultilevelGain, IsWhatTheEstimateShows) {
  const std::vector<double> rho{1, 0.95};
  const std::vector<double> cost{10, 0.2};
  const std::vector<LevelValues> pilot{family(rho, 20000)};
  const MultilevelGain gain = multilevel_gain(pilot, cost, 1);
  const std::size_t n = 20;
  const auto m = static_cast<std::size_t>(std::lround(n * gain.members[1]));
  const double alpha = 0.95 / 2;  // sigma_1 rho / sigma_2
  double squares = 0, bias = 0;
  constexpr int repeats = 2000;
  for (int k = 0; k < repeats; ++k) {
    const LevelValues sample = family(rho, m, 1000 + 1000 * static_cast<std::uint64_t>(k));
    double first = 0, few = 0, many = 0;
    for (std::size_t i = 0; i < m; ++i) {
      many += sample.values[1][i] / static_cast<double>(m);
      if (i >= n) continue;
      first += sample.values[0][i] / n;
      few += sample.values[1][i] / n;
    }
    const double error = first + alpha * (many - few) - 3;
    squares += error * error / repeats;
    bias += error / repeats;
  }
  const double seconds = n * cost[0] + static_cast<double>(m) * cost[1];
  const double plain = cost[0] / seconds;  // variance of plain sampling for these seconds
  EXPECT_NEAR(plain / squares, gain.gain, 0.1 * gain.gain);
  EXPECT_NEAR(bias, 0, 4 * std::sqrt(squares / repeats));
}

TEST(MultilevelGain, LeavesOutALevelThatDoesNotPay) {
  // The second costs as much as the first and knows less; the third is cheap.
  const std::vector<double> cost{8, 8, 0.1};
  const std::vector<LevelValues> results{family({1, 0.9, 0.8}, 5000)};
  EXPECT_THAT(multilevel_gain(results, cost, 1).levels, ElementsAre(0U, 2U));
  const std::vector<LevelValues> nothing{family({1, 0.05}, 5000)};
  const MultilevelGain none = multilevel_gain(nothing, std::vector<double>{1, 0.5}, 1);
  EXPECT_THAT(none.levels, ElementsAre(0U));
  EXPECT_DOUBLE_EQ(none.gain, 1);
}

TEST(MultilevelGain, UsesALadder) {
  const std::vector<double> cost{100, 10, 0.1};
  const std::vector<LevelValues> results{family({1, 0.99, 0.9}, 20000)};
  const MultilevelGain gain = multilevel_gain(results, cost, 1);
  EXPECT_THAT(gain.levels, ElementsAre(0U, 1U, 2U));
  EXPECT_GT(gain.gain, multilevel_gain(std::vector<LevelValues>{family({1, 0.99}, 20000)},
                                       std::vector<double>{100, 10}, 1)
                           .gain);
  EXPECT_LT(gain.members[1], gain.members[2]);
}

TEST(MultilevelGain, ServesAllResultsAtOnce) {
  const std::vector<double> cost{8, 0.1};
  const std::vector<LevelValues> results{family({1, 0.99}, 20000, 1), family({1, 0.7}, 20000, 9)};
  const MultilevelGain both = multilevel_gain(results, cost, 1);
  ASSERT_EQ(both.gains.size(), 2U);
  EXPECT_GT(both.gains[0], both.gains[1]);
  EXPECT_NEAR(both.gain, 2 / (1 / both.gains[0] + 1 / both.gains[1]), 1e-9);
}

/// Two cells with one coefficient: sums of covariances, not their mean.
TEST(SquaredCorrelation, OfAMapSumsOverItsCells) {
  LevelValues map{"map", {{0, 1, 1, 0, 0, 0}, {0, 1, 0, 0, 0, 1}}, 2};  // three members, two cells
  // Cell 1: deviations (-2/3, 1/3, 1/3) and (-1/3, 2/3, -1/3); cell 2: none and (-1/3, -1/3, 2/3).
  const double both = 2.0 / 9 + 2.0 / 9 - 1.0 / 9, first = 6.0 / 9, level = 12.0 / 9;
  EXPECT_NEAR(squared_correlation(map, 1), both * both / (first * level), 1e-12);
  map.values[1].assign(6, 0);
  EXPECT_EQ(squared_correlation(map, 1), 0);
}

}  // namespace
}  // namespace sturz
