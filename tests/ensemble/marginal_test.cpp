// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/marginal.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/unit_cube.hpp"
#include "tests/support/distributions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sturz {
namespace {

using test::bounded;
using test::lognormal;
using test::normal;
using Kind = Distribution::Kind;
constexpr double fractions[] = {1e-6, 0.01, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99, 1 - 1e-6};

/// Distribution function of the standard normal.
double phi(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

TEST(Marginal, UniformIsAStraightLine) {
  const Marginal m(bounded(Kind::uniform, -2, 6));
  for (const double u : fractions) EXPECT_NEAR(m.quantile(u), -2 + 8 * u, 1e-12);
  EXPECT_DOUBLE_EQ(m.median(), 2);
}

TEST(Marginal, LogUniformIsAStraightLineInTheLogarithm) {
  const Marginal m(bounded(Kind::log_uniform, 1e-3, 10));
  for (const double u : fractions) EXPECT_NEAR(std::log10(m.quantile(u)), -3 + 4 * u, 1e-12);
  EXPECT_NEAR(m.median(), 0.1, 1e-14);
}

TEST(Marginal, NormalInvertsTheErrorFunction) {
  const Marginal m(normal(5, 2));
  for (const double u : fractions) EXPECT_NEAR(phi((m.quantile(u) - 5) / 2), u, 1e-12);
  EXPECT_NEAR(m.quantile(0.975), 5 + 2 * 1.959963984540054, 1e-12);
  EXPECT_DOUBLE_EQ(m.median(), 5);
}

TEST(Marginal, TruncatedNormalInvertsTheCutErrorFunction) {
  Distribution d = normal(0.5, 0.2);
  for (const bool has_min : {false, true})
    for (const bool has_max : {false, true}) {
      d.min = has_min ? std::optional(0.3) : std::nullopt;
      d.max = has_max ? std::optional(0.55) : std::nullopt;
      const Marginal m(d);
      const double from = has_min ? phi(-1) : 0, to = has_max ? phi(0.25) : 1;
      for (const double u : fractions)
        EXPECT_NEAR(phi((m.quantile(u) - 0.5) / 0.2), from + u * (to - from), 1e-10)
            << has_min << has_max << ' ' << u;
    }
}

TEST(Marginal, LognormalHasTheMedianThatItIsGiven) {
  const Marginal m(lognormal(2000, 0.7));
  EXPECT_NEAR(m.median(), 2000, 1e-8);
  for (const double u : fractions) EXPECT_NEAR(phi(std::log(m.quantile(u) / 2000) / 0.7), u, 1e-12);
}

TEST(Marginal, TruncatedLognormalInvertsTheCutDistribution) {
  Distribution d = lognormal(1, 1);
  d.min = 0.5;
  d.max = 4;
  const Marginal m(d);
  const double from = phi(std::log(0.5)), to = phi(std::log(4));
  for (const double u : fractions)
    EXPECT_NEAR(phi(std::log(m.quantile(u))), from + u * (to - from), 1e-9) << u;
}

TEST(Marginal, TriangularFollowsItsTwoParabolas) {
  Distribution d = bounded(Kind::triangular, 0.4, 0.8);
  d.mode = 0.5;
  const Marginal m(d);
  const double knee = 0.25;  // (mode - min) / (max - min)
  for (const double u : fractions) {
    const double exact =
        u < knee ? 0.4 + std::sqrt(u * 0.4 * 0.1) : 0.8 - std::sqrt((1 - u) * 0.4 * 0.3);
    EXPECT_NEAR(m.quantile(u), exact, 1e-12) << u;
  }
}

TEST(Marginal, TriangularMayHaveItsModeAtAnEnd) {
  Distribution d = bounded(Kind::triangular, 0, 1);
  d.mode = 0;
  EXPECT_NEAR(Marginal(d).quantile(0.75), 0.5, 1e-12);
  d.mode = 1;
  EXPECT_NEAR(Marginal(d).quantile(0.25), 0.5, 1e-12);
}

TEST(Marginal, BetaMatchesClosedForms) {
  Distribution d = bounded(Kind::beta, 1, 3);
  d.alpha = 2;
  d.beta = 1;  // F(x) = x^2
  const Marginal squared(d);
  for (const double u : fractions) EXPECT_NEAR(squared.quantile(u), 1 + 2 * std::sqrt(u), 1e-9);
  d.alpha = 1;
  d.beta = 3;  // F(x) = 1 - (1 - x)^3
  const Marginal cubed(d);
  for (const double u : fractions)
    EXPECT_NEAR(cubed.quantile(u), 3 - 2 * std::cbrt(1 - u), 1e-9) << u;
  d.alpha = 4;
  d.beta = 3;  // F(x) = 15 x^4 - 24 x^5 + 10 x^6
  const Marginal pore(d);
  for (const double u : fractions) {
    const double x = (pore.quantile(u) - 1) / 2;
    EXPECT_NEAR(std::pow(x, 4) * (15 - 24 * x + 10 * x * x), u, 1e-9) << u;
  }
}

TEST(Marginal, DiscreteStepsAtTheCumulatedWeights) {
  Distribution d;
  d.kind = Kind::discrete;
  d.values = {30, 10, 20};
  d.weights = {1, 2, 5};  // need not sum to one
  const Marginal m(d);
  EXPECT_EQ(m.quantile(0.2), 10);
  EXPECT_EQ(m.quantile(0.26), 20);
  EXPECT_EQ(m.quantile(0.87), 20);
  EXPECT_EQ(m.quantile(0.88), 30);
  d.weights.clear();
  EXPECT_EQ(Marginal(d).median(), 20);
}

TEST(Marginal, TableRunsThroughItsSortedObservations) {
  Distribution d;
  d.kind = Kind::table;
  d.values = {1, 2, 3, 4, 10};
  const Marginal m(d);
  EXPECT_NEAR(m.quantile(0), 1, 1e-8);
  EXPECT_DOUBLE_EQ(m.median(), 3);
  EXPECT_DOUBLE_EQ(m.quantile(0.875), 7);
  EXPECT_NEAR(m.quantile(1), 10, 1e-7);
}

TEST(Marginal, StaysFiniteAndInsideItsSupportAtTheEnds) {
  Distribution cut = normal(0, 1);
  cut.min = -1;
  Distribution cut_log = lognormal(1, 2);
  cut_log.max = 5;
  Distribution beta = bounded(Kind::beta, 0, 0.6);
  beta.alpha = 0.5;
  beta.beta = 8;
  for (const Distribution& d :
       {bounded(Kind::uniform, 0.1, 0.4), normal(0, 1), cut, lognormal(1, 1), cut_log, beta,
        bounded(Kind::log_uniform, 0.02, 0.5)}) {
    const Marginal m(d);
    double before = -std::numeric_limits<double>::infinity();
    for (const double u : {0.0, 1e-300, unit_margin, 0.3, 0.7, 1 - unit_margin, 1.0}) {
      const double x = m.quantile(u);
      EXPECT_TRUE(std::isfinite(x));
      EXPECT_GE(x, before) << "falls at " << u;
      EXPECT_GE(x, d.min.value_or(x));
      EXPECT_LE(x, d.max.value_or(x));
      before = x;
    }
  }
}

TEST(Marginal, RefusesParametersThatMakeNoDistribution) {
  Distribution nothing_left = normal(0, 1);
  nothing_left.min = 8;
  Distribution beta = bounded(Kind::beta, 0, 1);
  beta.alpha = -1;
  beta.beta = 2;
  Distribution late_mode = bounded(Kind::triangular, 0, 1);
  late_mode.mode = 2;
  Distribution no_weight;
  no_weight.kind = Kind::discrete;
  no_weight.values = {1, 2};
  no_weight.weights = {0, 0};
  Distribution no_values;
  no_values.kind = Kind::table;
  for (const Distribution& d :
       {bounded(Kind::uniform, 2, 2), bounded(Kind::uniform, 3, 2), normal(0, 0), normal(0, -1),
        normal(NAN, 1), lognormal(-1, 1), bounded(Kind::log_uniform, 0, 1), nothing_left, beta,
        late_mode, no_weight, no_values})
    EXPECT_THROW(Marginal(d, "basal.friction_coefficient"), SetupError);
}

TEST(Marginal, NamesTheKeyInItsErrors) {
  try {
    const Marginal m(normal(0, -1), "basal.friction_coefficient");
    FAIL() << "no error for a negative sd";
  } catch (const SetupError& error) {
    EXPECT_STREQ(error.what(),
                 "basal.friction_coefficient: sd must be > 0. Correct its parameters.");
  }
}

}  // namespace
}  // namespace sturz
