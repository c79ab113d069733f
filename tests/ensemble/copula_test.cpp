// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/copula.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/marginal.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace sturz {
namespace {

const std::vector<std::string> keys{"a", "b", "c"};

double pearson(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    yy += (y[i] - my) * (y[i] - my);
    xy += (x[i] - mx) * (y[i] - my);
  }
  return xy / std::sqrt(xx * yy);
}

std::vector<double> ranks(const std::vector<double>& x) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto i, auto j) { return x[i] < x[j]; });
  std::vector<double> rank(x.size());
  for (std::size_t r = 0; r < order.size(); ++r) rank[order[r]] = static_cast<double>(r);
  return rank;
}

/// Columns of the dependent cube.
std::vector<std::vector<double>> columns(Design design, const Copula& copula) {
  std::vector<std::vector<double>> result(keys.size());
  for (const auto& row : draw_unit_cube(design, 4096, keys.size(), 17)) {
    const std::vector<double> u = copula.apply(row);
    for (std::size_t k = 0; k < u.size(); ++k) result[k].push_back(u[k]);
  }
  return result;
}

TEST(Copula, ReproducesItsCorrelationsInEveryDesign) {
  const Copula copula(keys, {{"a/b", -0.3}, {"c/b", 0.6}});
  Distribution standard;
  standard.kind = Distribution::Kind::normal;
  standard.sd = 1;
  const Marginal normal(standard);
  // Of normal scores; the third follows from the others being given and is 0.
  const struct {
    std::size_t i, j;
    double r;
  } pairs[] = {{0, 1, -0.3}, {1, 2, 0.6}, {0, 2, 0}};
  for (const Design design : {Design::monte_carlo, Design::latin_hypercube, Design::sobol}) {
    const auto u = columns(design, copula);
    auto z = u;
    for (auto& column : z)
      for (double& v : column) v = normal.quantile(v);
    for (const auto& [i, j, r] : pairs) {
      const double tolerance = 4 * (1 - r * r) / std::sqrt(4096.0);
      EXPECT_NEAR(pearson(z[i], z[j]), r, tolerance) << to_string(design);
      const double spearman = 6 / std::numbers::pi * std::asin(r / 2);  // of a Gaussian copula
      EXPECT_NEAR(pearson(ranks(u[i]), ranks(u[j])), spearman, tolerance) << to_string(design);
    }
  }
}

TEST(Copula, KeepsTheMarginalsUniform) {
  const auto u = columns(Design::sobol, Copula(keys, {{"a/b", 0.8}, {"a/c", -0.5}}));
  for (const auto& column : u) {
    std::vector<double> sorted = column;
    std::sort(sorted.begin(), sorted.end());
    double worst = 0;  // Kolmogorov-Smirnov distance
    for (std::size_t i = 0; i < sorted.size(); ++i)
      worst = std::max(worst, std::abs(sorted[i] - (static_cast<double>(i) + 0.5) / 4096));
    EXPECT_LT(worst, 1.36 / std::sqrt(4096.0));
  }
}

TEST(Copula, LeavesIndependentCoordinatesUntouchedBitByBit) {
  const std::vector<double> row{0.123456789, 0.987654321, 0.5555};
  EXPECT_EQ(Copula(keys, {}).apply(row), row);
  EXPECT_EQ(Copula(keys, {{"a/b", 0.0}}).apply(row), row);
  const std::vector<double> mixed = Copula(keys, {{"a/b", 0.5}}).apply(row);
  EXPECT_EQ(mixed[0], row[0]);
  EXPECT_NE(mixed[1], row[1]);
  EXPECT_EQ(mixed[2], row[2]);
}

TEST(Copula, StaysInsideTheOpenCubeInItsCorners) {
  const Copula copula(keys, {{"a/b", 0.999}});
  for (const double corner : {unit_margin, 1 - unit_margin})
    for (const double u : copula.apply(std::vector<double>(3, corner))) {
      EXPECT_GE(u, unit_margin);
      EXPECT_LE(u, 1 - unit_margin);
    }
}

TEST(Copula, RefusesCorrelationsThatMakeNoSense) {
  using Map = std::map<std::string, double>;
  for (const Map& wrong : {Map{{"a/x", 0.3}}, Map{{"a/a", 0.3}}, Map{{"a", 0.3}}, Map{{"a/b", 1}},
                           Map{{"a/b", -1.2}}, Map{{"a/b", NAN}}, Map{{"a/b", 0.2}, {"b/a", 0.2}},
                           Map{{"a/b", 0.9}, {"b/c", 0.9}, {"a/c", -0.9}}})
    EXPECT_THROW(Copula(keys, wrong), SetupError);
}

}  // namespace
}  // namespace sturz
