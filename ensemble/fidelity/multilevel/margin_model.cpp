// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/margin_model.hpp"

#include "engine/core/error.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace sturz {
namespace {

constexpr std::size_t one = most_levels;  // place of the constant
/// Of each feature's own variance, against features that tell the same.
constexpr double ridge = 1e-4;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_levels, most_levels>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_levels, 1>;

}  // namespace

double MarginModel::margin(const Margins& x) const {
  double y = constant;
  for (std::size_t l = first; l < n_levels; ++l) y += slopes[l] * x[l];
  return y;
}

double MarginModel::probability(const Margins& x, double threshold) const {
  const double y = margin(x) - threshold;
  if (scale <= 0) return y > 0 ? 1 : 0;
  return 0.5 * std::erfc(-y / (scale * std::numbers::sqrt2));
}

void MarginSums::add(const Margins& x, double weight) {
  std::array<double, most_levels + 1> z{};
  std::copy_n(x.begin(), n_levels_, z.begin());
  z[one] = 1;
  for (std::size_t i = 0; i <= one; ++i)
    for (std::size_t j = i; j <= one; ++j) sum_[i][j] += weight * z[i] * z[j];
}

MarginSums& MarginSums::operator+=(const MarginSums& o) {
  for (std::size_t i = 0; i <= one; ++i)
    for (std::size_t j = i; j <= one; ++j) sum_[i][j] += o.sum_[i][j];
  return *this;
}

MarginModel MarginSums::fit(std::size_t first, double n_draws, double least_scale) const {
  MarginModel model;
  model.first = first;
  model.n_levels = n_levels_;
  model.scale = least_scale;
  const double w = sum_[one][one];
  if (!(w > 0)) return model;
  const auto mean = [&](std::size_t i) { return sum_[i][one] / w; };
  const auto moment = [&](std::size_t i, std::size_t j) {
    return sum_[std::min(i, j)][std::max(i, j)] / w - mean(i) * mean(j);
  };
  const auto p = static_cast<Eigen::Index>(n_levels_ - first);
  Matrix a(p, p);
  Vector b(p);
  for (Eigen::Index i = 0; i < p; ++i) {
    const std::size_t l = first + static_cast<std::size_t>(i);
    b(i) = moment(0, l);
    for (Eigen::Index j = 0; j < p; ++j) a(i, j) = moment(l, first + static_cast<std::size_t>(j));
  }
  double remains = moment(0, 0);
  model.constant = mean(0);
  if (p > 0 && a.diagonal().minCoeff() > 0) {
    const Vector d = a.diagonal();
    a.diagonal() *= 1 + ridge;
    const Vector c = a.ldlt().solve(b);
    a.diagonal() = d;
    remains += c.dot(a * c) - 2 * c.dot(b);
    for (Eigen::Index i = 0; i < p; ++i) {
      const std::size_t l = first + static_cast<std::size_t>(i);
      model.slopes[l] = c(i);
      model.constant -= c(i) * mean(l);
    }
  }
  const double freedom = std::max(1.0, n_draws - 1 - static_cast<double>(p));
  model.scale = std::max(least_scale, std::sqrt(std::max(0.0, remains) * n_draws / freedom));
  return model;
}

FoldedModels::FoldedModels(std::span<const MarginSums> folds, std::span<const double> counts,
                           double least_scale)
    : n_levels_(folds.front().n_levels()) {
  const double n = std::accumulate(counts.begin(), counts.end(), 0.0);
  for (std::size_t f = 0; f < folds.size(); ++f) {
    // Added up anew: what one heavy draw hides of the others does not come back by subtraction.
    MarginSums others(n_levels_);
    for (std::size_t g = 0; g < folds.size(); ++g)
      if (g != f) others += folds[g];
    shares_.push_back(counts[f] / n);
    for (std::size_t l = 1; l < n_levels_; ++l)
      models_.push_back(others.fit(l, n - counts[f], least_scale));
  }
}

template <class Value>
void FoldedModels::tell(std::size_t from, std::optional<std::size_t> fold, std::span<double> told,
                        Value value) const {
  const std::size_t n_models = n_levels_ - 1;
  for (std::size_t l = std::max<std::size_t>(from, 1); l < n_levels_; ++l) {
    double mean = 0;
    if (fold)
      mean = value(models_[*fold * n_models + l - 1]);
    else
      for (std::size_t f = 0; f < shares_.size(); ++f)
        mean += shares_[f] * value(models_[f * n_models + l - 1]);
    told[l - std::max<std::size_t>(from, 1)] = mean;
  }
}

void FoldedModels::margins(const Margins& x, std::size_t from, std::optional<std::size_t> fold,
                           std::span<double> told) const {
  tell(from, fold, told, [&](const MarginModel& m) { return m.margin(x); });
}

void FoldedModels::probabilities(const Margins& x, std::size_t from,
                                 std::optional<std::size_t> fold, std::span<double> told) const {
  tell(from, fold, told, [&](const MarginModel& m) { return m.probability(x); });
}

void FoldedModels::shares_below(double t, const Margins& x, std::size_t from,
                                std::optional<std::size_t> fold, std::span<double> told) const {
  tell(from, fold, told, [&](const MarginModel& m) { return 1 - m.probability(x, t); });
}

}  // namespace sturz
