// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/weighting/weighted_sample.hpp"

#include "ensemble/calibration/identifiability.hpp"
#include "ensemble/sampling/copula.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace sturz {
namespace {

using testing::ElementsAre;

TEST(WeightedSample, WeightsKnowOverflowAndNothingness) {
  const std::vector<double> huge{1000, 1000 + std::log(3.0)};
  const auto w = normalised_weights(huge);
  EXPECT_NEAR(w[0], 0.25, 1e-12);
  EXPECT_NEAR(w[1], 0.75, 1e-12);
  const double none = -std::numeric_limits<double>::infinity();
  EXPECT_TRUE(normalised_weights(std::vector<double>{none, none, std::nan("")}).empty());
  EXPECT_TRUE(normalised_weights({}).empty());
}

TEST(WeightedSample, EffectiveSizeOfEqualAndSingleWeights) {
  EXPECT_NEAR(effective_size(std::vector<double>(7, 1.0 / 7)), 7, 1e-12);
  EXPECT_NEAR(effective_size(std::vector<double>{1, 0, 0}), 1, 1e-12);
  EXPECT_NEAR(effective_size(std::vector<double>{0.5, 0.25, 0.25}), 8.0 / 3, 1e-12);
}

TEST(WeightedSample, QuantilesCountRepeatedValuesAsWeights) {
  const std::vector<double> values{3, 1, 2}, weights{0.25, 0.25, 0.5};
  EXPECT_EQ(weighted_quantile(values, weights, 0.5), 2);
  EXPECT_EQ(weighted_quantile(values, weights, 0), 1);
  EXPECT_EQ(weighted_quantile(values, weights, 1), 3);
  EXPECT_NEAR(weighted_quantile(values, weights, 0.3125), 1.5, 1e-12);  // between 1/8 and 1/2
  const std::vector<double> holes{std::nan(""), 5};
  EXPECT_EQ(weighted_quantile(holes, std::vector<double>{0.9, 0.1}, 0.5), 5);
  EXPECT_TRUE(std::isnan(weighted_quantile({}, {}, 0.5)));
}

TEST(WeightedSample, EqualWeightsGiveWilsonsOwnInterval) {
  std::vector<double> values(40, 0.0);
  for (std::size_t i = 0; i < 10; ++i) values[i] = 1;
  const auto found = weighted_exceedance(values, std::vector<double>(40, 1.0 / 40), 0.5);
  const ProbabilityBounds plain = wilson_interval(10, 40);
  EXPECT_NEAR(found.share, 0.25, 1e-12);
  EXPECT_NEAR(found.bounds.lower, plain.lower, 1e-9);
  EXPECT_NEAR(found.bounds.upper, plain.upper, 1e-9);
}

/// Prior u even on (0, 1); weights of a normal likelihood about 0.5; P(u > 0.55) under it.
TEST(WeightedSample, IntervalsAtTheEffectiveSizeHoldTheTruth) {
  constexpr int n_trials = 400;
  constexpr double sd = 0.12, middle = 0.5, threshold = 0.55;
  const auto cdf = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  const double all = cdf((1 - middle) / sd) - cdf(-middle / sd);
  const double truth = (cdf((1 - middle) / sd) - cdf((threshold - middle) / sd)) / all;
  int held = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    std::vector<double> values, logs;
    for (const auto& row : draw_unit_cube(Design::monte_carlo, 200, 1, 900 + trial)) {
      values.push_back(row[0]);
      logs.push_back(-0.5 * std::pow((row[0] - middle) / sd, 2));
    }
    const auto found = weighted_exceedance(values, normalised_weights(logs), threshold);
    held += found.bounds.lower <= truth && truth <= found.bounds.upper;
  }
  EXPECT_GE(held, 0.92 * n_trials);  // nominal 95 %
}

TEST(WeightedSample, ResamplingComesAsOftenAsTheWeightSays) {
  EXPECT_THAT(resampled(std::vector<double>{0.5, 0, 0.25, 0.25}, 4), ElementsAre(0, 0, 2, 3));
  EXPECT_THAT(resampled(std::vector<double>{1}, 3), ElementsAre(0, 0, 0));
  EXPECT_TRUE(resampled({}, 3).empty());
}

/// Two points of equal weight have the variance of a sample of two, one point none at all.
TEST(Identifiability, FewWeightsDoNotTellMoreThanTheyKnow) {
  Posterior p;
  p.cube = {{0.2, 0.4}, {0.4, 0.8}, {0.9, 0.9}};
  p.weights = {0.5, 0.5, 0};
  EXPECT_NEAR(identifiability_of(p).sd[0], std::sqrt(0.02), 1e-12);
  p.weights = {1, 0, 0};
  const Identifiability one = identifiability_of(p);
  EXPECT_TRUE(std::isnan(one.variance_removed[0]));
  EXPECT_TRUE(std::isnan(one.sd[1]));
  EXPECT_TRUE(std::isnan(one.directions[0].variance_left));
  EXPECT_TRUE(one.ridges.empty());
}

/// Nothing observed, nothing told, and no ridge of the prior's own correlation.
TEST(Identifiability, APriorThatIsCorrelatedTellsNothingOfItself) {
  const std::vector<std::string> keys{"a", "b"};
  const Copula copula(keys, {{"a/b", 0.9}});
  Posterior prior;
  prior.cube = draw_unit_cube(Design::sobol, 2048, 2, 9);
  prior.weights.assign(2048, 1.0 / 2048);
  const Identifiability nothing = identifiability_of(prior, &copula);
  EXPECT_GT(nothing.correlation[0][1], 0.8);
  EXPECT_TRUE(nothing.ridges.empty());
  for (const Direction& d : nothing.directions) EXPECT_NEAR(d.variance_left, 1, 0.05);
  for (const double told : nothing.variance_removed) EXPECT_LT(told, 0.05);
}

}  // namespace
}  // namespace sturz
