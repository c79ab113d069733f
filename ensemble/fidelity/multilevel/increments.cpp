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

double student_width(double share, double degrees) {
  return OT::DistFunc::qStudent(std::clamp(degrees, 1.0, 1e6), 0.5 + share / 2);
}

Interval MultilevelMean::bounds_90() const {
  if (!std::isfinite(standard_error)) return {};
  const double half = student_width(0.9, degrees) * standard_error;
  return {mean - half, mean + half};
}

void IncrementMoments::add(std::size_t from, std::span<const double> told) {
  expect(from + told.size() == n_levels_, "what is told by all levels of the draw");
  std::array<double, most_levels> added{};
  for (std::size_t l = from; l < n_levels_; ++l)
    added[l] = told[l - from] - (l + 1 < n_levels_ ? told[l + 1 - from] : 0);
  for (std::size_t l = from; l < n_levels_; ++l) {
    n_[l] += 1;
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

MultilevelMean IncrementMoments::estimate(double least_own) const {
  MultilevelMean e;
  e.mean = mean();
  const double more = std::max(0.0, least_own - variance(0)) / n_[0];
  const double variance_all = variance_of_mean(0) + more;
  e.standard_error = std::sqrt(variance_all);
  double parts = 0, sum = 0;
  for (std::size_t l = 0; l < n_levels_; ++l) {
    const double part = variance(l) / n_[l];
    sum += part;
    parts += part * part / (n_[l] - 1);
  }
  e.degrees = parts > 0 ? sum * sum / parts : n_[0] - 1;
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
