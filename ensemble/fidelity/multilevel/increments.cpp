// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/increments.hpp"

#include "engine/core/error.hpp"

#include <openturns/DistFunc.hxx>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Draws for one unit of the multiplier: sqrt(V / C), levels merged where a cheaper one would have
/// fewer (pool adjacent violators).
std::vector<double> shape_of(std::span<const double> variances, std::span<const double> costs) {
  struct Block {
    double variance, cost;
    std::size_t levels;
    double ratio() const { return std::sqrt(variance / cost); }
  };
  std::vector<Block> blocks;
  for (std::size_t l = 0; l < variances.size(); ++l) {
    blocks.push_back({std::max(variances[l], 0.0), costs[l], 1});
    while (blocks.size() > 1 && blocks.back().ratio() <= blocks[blocks.size() - 2].ratio()) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().variance += last.variance;
      blocks.back().cost += last.cost;
      blocks.back().levels += last.levels;
    }
  }
  std::vector<double> shape;
  for (const Block& b : blocks) shape.insert(shape.end(), b.levels, b.ratio());
  return shape;
}

/// Variance and cost of one unit of the multiplier.
Allocation unit_of(std::span<const double> variances, std::span<const double> costs) {
  expect(!variances.empty() && variances.size() == costs.size() &&
             *std::min_element(costs.begin(), costs.end()) > 0,
         "levels with a cost each");
  Allocation a;
  a.draws = shape_of(variances, costs);
  for (std::size_t l = 0; l < a.draws.size(); ++l) {
    if (a.draws[l] > 0) a.variance += std::max(variances[l], 0.0) / a.draws[l];
    a.cost += costs[l] * a.draws[l];
  }
  return a;
}

Allocation times(Allocation a, double factor) {
  for (double& n : a.draws) n *= factor;
  a.variance /= factor;
  a.cost *= factor;
  return a;
}

}  // namespace

/// Beyond it few draws tell nothing of how skewed the error is.
constexpr double most_skewness = 0.6;
/// Over the width of the bounds: at 1 the transform's root has its pole at one of them.
constexpr double most_bend = 0.8;

double student_width(double share, double degrees) {
  return OT::DistFunc::qStudent(std::clamp(degrees, 1.0, 1e6), 0.5 + share / 2);
}

Interval MultilevelMean::even_bounds_90() const {
  if (!std::isfinite(standard_error)) return {};
  const double half = student_width(0.9, degrees) * standard_error;
  return {mean - half, mean + half};
}

Interval MultilevelMean::bounds_90() const {
  const double width = student_width(0.9, degrees),
               most = std::min(most_skewness, most_bend / width);
  const double a = std::clamp(skewness, -most, most);
  if (!std::isfinite(standard_error) || std::abs(a) < 1e-3) return even_bounds_90();
  const auto straight = [a](double t) { return 3 / a * (std::cbrt(1 + a * (t - a / 6)) - 1); };
  return {mean - standard_error * straight(width), mean - standard_error * straight(-width)};
}

void IncrementMoments::add(std::size_t from, std::span<const double> told) {
  expect(from + told.size() == n_levels_, "what is told by all levels of the draw");
  std::array<double, most_levels> added{};
  for (std::size_t l = from; l < n_levels_; ++l)
    added[l] = told[l - from] - (l + 1 < n_levels_ ? told[l + 1 - from] : 0);
  for (std::size_t l = from; l < n_levels_; ++l) {
    n_[l] += 1;
    cube_[l] += added[l] * added[l] * added[l];
    for (std::size_t m = l; m < n_levels_; ++m) {
      sum_[l][m] += added[m];
      product_[l][m] += added[l] * added[m];
    }
  }
}

double IncrementMoments::increment(std::size_t level) const {
  return n_[level] > 0 ? sum_[level][level] / n_[level] : nan_d;
}

double IncrementMoments::covariance(std::size_t dear, std::size_t cheap) const {
  if (n_[dear] < 2) return nan_d;
  return (product_[dear][cheap] - sum_[dear][dear] * sum_[dear][cheap] / n_[dear]) / (n_[dear] - 1);
}

double IncrementMoments::variance(std::size_t level) const {
  const double v = covariance(level, level);
  return v < 0 ? 0 : v;
}

double IncrementMoments::mean() const {
  double mean = 0;
  for (std::size_t l = 0; l < n_levels_; ++l) mean += increment(l);
  return mean;
}

double IncrementMoments::variance_of_mean(std::size_t first) const {
  double own = 0, between = 0;
  for (std::size_t l = first; l < n_levels_; ++l) {
    own += variance(l) / n_[l];
    for (std::size_t m = l + 1; m < n_levels_; ++m) between += 2 * covariance(l, m) / n_[m];
  }
  // Known from the draws of the dearer level only: such covariances take no more than half away.
  return std::max(own + between, own / 2);
}

double IncrementMoments::third_moment(std::size_t level) const {
  const double n = n_[level], mean = sum_[level][level] / n, square = product_[level][level] / n;
  return cube_[level] / n - 3 * mean * square + 2 * mean * mean * mean;
}

MultilevelMean IncrementMoments::estimate(std::span<const double> least) const {
  MultilevelMean e;
  e.mean = mean();
  double variance_all = variance_of_mean(0), parts = 0, sum = 0, third = 0;
  for (std::size_t l = 0; l < n_levels_; ++l) {
    const double own = variance(l);
    const double more = l < least.size() ? std::max(0.0, least[l] - own) : 0;
    variance_all += more / n_[l];
    const double part = (own + more) / n_[l];
    sum += part;
    parts += part * part / (n_[l] - 1);
    third += third_moment(l) / (n_[l] * n_[l]);
  }
  e.standard_error = std::sqrt(variance_all);
  e.degrees = parts > 0 ? sum * sum / parts : n_[0] - 1;
  if (variance_all > 0) e.skewness = third / (variance_all * e.standard_error);
  return e;
}

Allocation allocate_for_variance(std::span<const double> variances, std::span<const double> costs,
                                 double variance) {
  expect(variance > 0, "a variance above 0");
  const Allocation unit = unit_of(variances, costs);
  return times(unit, unit.variance / variance);
}

Allocation allocate_for_cost(std::span<const double> variances, std::span<const double> costs,
                             double cost) {
  const Allocation unit = unit_of(variances, costs);
  return times(unit, unit.cost > 0 ? cost / unit.cost : 0);
}

}  // namespace sturz
