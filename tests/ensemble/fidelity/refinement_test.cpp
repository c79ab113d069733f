// SPDX-License-Identifier: Apache-2.0
// Orders, limits and errors of series that are known in closed form.
#include "ensemble/fidelity/refinement.hpp"

#include "engine/core/random.hpp"
#include "ensemble/fidelity/power_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

const std::vector<double> four{8, 6, 4, 3};

/// limit + a d^p, with members around it that share their draws.
std::vector<std::vector<double>> series(const std::vector<double>& spacings, double limit, double a,
                                        double p, std::size_t members = 20, double own = 0) {
  std::vector<std::vector<double>> values(spacings.size());
  for (std::size_t l = 0; l < spacings.size(); ++l)
    for (std::size_t m = 0; m < members; ++m) {
      const double draw = unit_random(1, m) - 0.5;
      const double noise = own * (unit_random(2, m, l) - 0.5);
      values[l].push_back(limit * (1 + draw) + a * std::pow(spacings[l], p) * (1 + draw) + noise);
    }
  return values;
}

TEST(Refinement, FindsOrderAndLimitOfAPower) {
  for (const double p : {0.7, 1.0, 1.99}) {
    const auto values = series(four, 900, -3, p);
    const Refinement r = refine(four, values, 1);
    ASSERT_TRUE(r.converges) << p;
    EXPECT_NEAR(r.order, p, 1e-4);
    double draws = 0;
    for (std::size_t m = 0; m < 20; ++m) draws += (unit_random(1, m) - 0.5) / 20;
    EXPECT_NEAR(r.limit, 900 * (1 + draws), 1e-3);
    EXPECT_EQ(r.resampled_converging, 1);
  }
}

TEST(Refinement, AnOrderAboveTwoIsNotTrustedWithTheLimit) {
  const auto values = series(four, 900, -3, 2.7);
  const Refinement r = refine(four, values, 1);
  ASSERT_TRUE(r.converges);
  EXPECT_NEAR(r.order, 2.7, 1e-4);
  double draws = 0;
  for (std::size_t m = 0; m < 20; ++m) draws += (unit_random(1, m) - 0.5) / 20;
  const double error_of_finest = 3 * std::pow(3, 2.7) * (1 + draws);
  EXPECT_GT(r.limit - r.means.back(), 1.2 * error_of_finest);
  EXPECT_LT(r.limit - r.means.back(), 3 * error_of_finest);
}

TEST(Refinement, ThreeSpacingsAreEnough) {
  const std::vector<double> three{8, 5.5, 4};
  const Refinement r = refine(three, series(three, 10, 0.2, 1.4), 1);
  ASSERT_TRUE(r.converges);
  EXPECT_NEAR(r.order, 1.4, 1e-4);
}

TEST(Refinement, IntervalsHoldTheTruthUnderNoise) {
  int holds = 0;
  for (int k = 0; k < 100; ++k) {
    std::vector<std::vector<double>> values(four.size());
    for (std::size_t l = 0; l < four.size(); ++l)
      for (std::size_t m = 0; m < 40; ++m)
        values[l].push_back(100 + 0.5 * std::pow(four[l], 1.5) +
                            4 * (unit_random(7 + k, m, l) - 0.5));
    const Refinement r = refine(four, values, 3);
    EXPECT_GT(r.resampled_converging, 0.9);
    holds += r.limit_90.low <= 100 && 100 <= r.limit_90.high;
  }
  // Binomial: 90 of 100 expected, less than 82 in one of 100 trials.
  EXPECT_GE(holds, 82);
}

TEST(Refinement, WithoutOneDirectionThereIsNoOrder) {
  const std::vector<double> three{8, 6, 4};
  const Refinement r = refine(three, {{10, 12}, {13, 15}, {11, 13}}, 1);
  EXPECT_FALSE(r.converges);
  EXPECT_TRUE(std::isnan(r.order));
  EXPECT_DOUBLE_EQ(r.limit, 12);
}

TEST(Refinement, DivergingMeansHaveNoLimit) {
  const std::vector<double> three{8, 4, 2};
  const Refinement r = refine(three, {{10}, {11}, {14}}, 1);
  EXPECT_FALSE(r.converges);
}

TEST(Refinement, TwoSpacingsTellNoOrder) {
  const std::vector<double> two{8, 4};
  const Refinement r = refine(two, {{10}, {11}}, 1);
  EXPECT_FALSE(r.converges);
  EXPECT_DOUBLE_EQ(r.limit, 11);
}

TEST(Refinement, RefusesAnotherOrder) {
  const std::vector<double> rising{4, 8};
  EXPECT_THROW(refine(rising, {{1}, {2}}, 1), std::logic_error);
}

TEST(PowerLaw, IsFoundThroughItsPoints) {
  const std::vector<double> x{8, 4, 2};
  const std::vector<double> y{3 * std::pow(8, -3.5), 3 * std::pow(4, -3.5), 3 * std::pow(2, -3.5)};
  const PowerLaw law = fit_power_law(x, y, -4);
  EXPECT_NEAR(law.exponent, -3.5, 1e-12);
  EXPECT_NEAR(law.at(3), 3 * std::pow(3, -3.5), 1e-12);
  EXPECT_NEAR(law.worst_ratio, 1, 1e-12);
  const PowerLaw one = fit_power_law({x.data(), 1}, {y.data(), 1}, -4);
  EXPECT_EQ(one.exponent, -4);
  EXPECT_NEAR(one.at(8), y[0], 1e-15);
}

}  // namespace
}  // namespace sturz
