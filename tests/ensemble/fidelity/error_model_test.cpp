// SPDX-License-Identifier: Apache-2.0
// Expected errors of members whose law is known: what is said beside what a finer spacing shows.
#include "ensemble/fidelity/error_model.hpp"

#include "ensemble/fidelity/checked_error.hpp"
#include "ensemble/fidelity/error_curve.hpp"
#include "tests/ensemble/fidelity/made_up_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace sturz {
namespace {

using Values = std::vector<std::vector<double>>;
const std::vector<double> three{8, 6, 4};

using test::Law;
using test::members_of;

Values three_of(const Law& law, std::uint64_t seed, std::size_t n = 16) {
  return test::ladder_of(three, law, seed, n);
}

double root_mean_square(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(ErrorModel, KnowsALawWithoutScatter) {
  const std::vector<ErrorQuestion> asked{{4, 0}, {8, 0}, {4, 2}, {2, 0}};
  const Law law{1, 10, 0, 0, 0.05, 1};
  const auto sizes = expected_sizes(three, three_of(law, 1), 0, asked);
  const double truth[] = {10, 20, 5, 5};
  for (std::size_t i = 0; i < asked.size(); ++i) {
    EXPECT_NEAR(sizes[i].mean, truth[i], 0.2 * truth[i]) << i;
    EXPECT_NEAR(sizes[i].member, truth[i], 0.2 * truth[i]) << i;
  }
}

TEST(ErrorModel, TellsTheScatterOfMembersFromTheErrorOfTheirMean) {
  const auto sizes = expected_sizes(three, three_of({1, 0, 0, 0, 10, 1}, 5, 64), 0,
                                    std::vector<ErrorQuestion>{{4, 0}});
  EXPECT_LT(std::abs(std::log(sizes[0].member / 10)), std::log(1.5));
  EXPECT_LT(sizes[0].mean, 0.6 * sizes[0].member);
}

TEST(ErrorModel, NoSpacingIsBetterThanTheNoise) {
  const std::vector<ErrorQuestion> asked{{4, 0}, {0.5, 0}};
  const Law chaos{1, 0, 0, 0, 10, 0};  // as large at every spacing
  const auto sizes = expected_sizes(three, three_of(chaos, 3, 64), 10, asked);
  EXPECT_NEAR(sizes[0].member, 10, 2);
  EXPECT_GT(sizes[1].member, 9.5);
  EXPECT_LT(sizes[1].member, 12);
}

/// Laws from smooth to scatter alone, drawn anew 30 times each: what is said of a spacing that was
/// not given, and what it shows.
TEST(ErrorModel, IsWithinAFactorOfTwoOfWhatAFinerSpacingShows) {
  const std::vector<Law> laws{
      {1, 10, 0, 0, 1, 1}, {0.7, 10, 3, 1, 3, 1},  {1.4, 10, 5, 2, 1, 1},   {1, 3, 10, 2, 2, 1},
      {1, 3, 1, 5, 5, 1},  {1, 1, 1, 1, 10, 0.75}, {2, 10, 3, 0.5, 1, 1.25}};
  for (std::size_t k = 0; k < laws.size(); ++k) {
    int members = 0, means = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
      const std::uint64_t own_seed = 100 * (k + 1) + seed;
      const Values values = three_of(laws[k], own_seed);
      const std::vector<double> finer = members_of(laws[k], 0.5, 7, own_seed);
      const auto said = expected_sizes(three, values, 0, std::vector<ErrorQuestion>{{4, 2}});
      const double found = root_mean_square(values.back(), finer);
      members += said[0].member < 2 * found && found < 2 * said[0].member;
      double difference = 0;
      for (std::size_t m = 0; m < finer.size(); ++m)
        difference += (values.back()[m] - finer[m]) / static_cast<double>(finer.size());
      means += std::abs(difference) < 2 * said[0].mean;
    }
    EXPECT_GE(members, 24) << "law " << k;  // eight of ten
    // No more than two deviations. Missed by law 1 since the sizes of unknown deviations, not their
    // squares, are averaged: 23 of 30, and 48 of 60. mean_error_test.cpp looks from both sides.
    EXPECT_EQ(means >= 24, k != 1) << "law " << k << ": " << means;
  }
}

TEST(ErrorModel, TwoSpacingsLeanOnThePrior) {
  const std::vector<double> two{8, 4};
  const auto sizes =
      expected_sizes(two, {{1020, 1021}, {1010, 1011}}, 0, std::vector<ErrorQuestion>{{4, 0}});
  EXPECT_GT(sizes[0].mean, 4);
  EXPECT_LT(sizes[0].mean, 25);
}

TEST(ErrorModel, WhatDependsOnNoSpacingHasNoError) {
  const auto sizes = expected_sizes(three, {{1, 2}, {1, 2}, {1, 2}}, 0,
                                    std::vector<ErrorQuestion>{{8, 0}, {4, 2}});
  EXPECT_EQ(sizes[0].member, 0);
  EXPECT_EQ(sizes[1].mean, 0);
}

TEST(ErrorModel, RefusesSpacingsInAnotherOrder) {
  const std::vector<double> rising{4, 8};
  EXPECT_THROW(expected_sizes(rising, {{1}, {2}}, 0, {}), std::logic_error);
}

TEST(MapErrors, KnowShiftsThatAddUpFromScatterThatDoesNot) {
  const auto of = [](double bias, double scatter) {
    std::vector<std::vector<double>> d(3, std::vector<double>(3, 0));
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (i != j)
          d[i][j] = std::hypot(bias * (three[i] - three[j]) / 4, scatter * three[i] / 4,
                               scatter * three[j] / 4);
    return d;
  };
  const std::vector<ErrorQuestion> asked{{4, 0}, {8, 0}, {4, 2}};
  const auto shift = expected_distances(three, of(0.1, 0.001), 0, asked);
  EXPECT_NEAR(shift[0], 0.1, 0.03);
  EXPECT_NEAR(shift[1], 0.2, 0.03);
  EXPECT_NEAR(shift[2], 0.05, 0.015);
  const auto scatter = expected_distances(three, of(0.001, 0.1), 0, asked);
  EXPECT_NEAR(scatter[0], 0.1, 0.03);
  EXPECT_NEAR(scatter[2], std::hypot(0.1, 0.05), 0.03);
}

TEST(AnErrorCurve, IsAPowerBetweenItsPoints) {
  const ErrorCurve curve({8, 4, 2}, {16, 4, 2});
  EXPECT_DOUBLE_EQ(curve.at(4), 4);
  EXPECT_NEAR(curve.at(6), 4 * 1.5 * 1.5, 1e-12);
  EXPECT_NEAR(curve.at(1), 1, 1e-12);
  EXPECT_DOUBLE_EQ(curve.at(10), 16);
  EXPECT_TRUE(std::isnan(ErrorCurve().at(1)));
}

TEST(ACheckedError, IsMetByAFactorOfTwoAndInTheNoiseByNoise) {
  CheckedError c;
  c.said = 0.02, c.found = 0.011, c.noise = 0;
  EXPECT_TRUE(c.is_met());
  c.found = 0.009;
  EXPECT_FALSE(c.is_met());
  c.noise = 0.01;  // what was found is noise, and so is what was said
  EXPECT_TRUE(c.is_met());
  c.noise = 0.0095;
  EXPECT_FALSE(c.is_met());
  EXPECT_TRUE(c.is_told());
  c.found = nan_d;  // no member reaches the threshold: neither met nor missed
  EXPECT_FALSE(c.is_told());
}

}  // namespace
}  // namespace sturz
