// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/level_scatter.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// y ~ a + b x, both not negative, with weights. \return {a, b}
std::array<double, 2> fit(std::span<const double> x, std::span<const double> y,
                          std::span<const double> weight) {
  double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    w += weight[k];
    wx += weight[k] * x[k];
    wy += weight[k] * y[k];
    wxx += weight[k] * x[k] * x[k];
    wxy += weight[k] * x[k] * y[k];
  }
  const double det = w * wxx - wx * wx;
  if (!(det > 1e-12 * w * wxx)) return {wy / w, 0};
  const double b = (w * wxy - wx * wy) / det, a = (wy - b * wx) / w;
  if (b < 0) return {wy / w, 0};
  if (a < 0) return {0, wxy / wxx};
  return {a, b};
}

}  // namespace

void LevelScatter::add(std::size_t from, std::span<const double> told) {
  const double size = told.back();
  if (n_ == 0) first_ = size;
  n_ += 1;
  sum_ += size - first_;
  squares_ += (size - first_) * (size - first_);
  for (std::size_t l = from; l < n_levels_; ++l)
    of_level_[l].push_back({told[l - from] - (l + 1 < n_levels_ ? told[l + 1 - from] : 0), size});
}

std::vector<double> LevelScatter::doubt() const {
  std::vector<double> doubt(n_levels_, 0);
  for (std::size_t l = 0; l < n_levels_; ++l) {
    const auto n = static_cast<double>(of_level_[l].size());
    double mean = 0, second = 0, fourth = 0;
    for (const One& d : of_level_[l]) mean += d.increment / n;
    for (const One& d : of_level_[l]) {
      const double square = (d.increment - mean) * (d.increment - mean);
      second += square / n;
      fourth += square * square / n;
    }
    const double kurtosis = second > 0 ? fourth / (second * second) : 0;
    doubt[l] = std::sqrt((std::max(3.0, kurtosis) - 1) / n);
  }
  return doubt;
}

std::vector<double> LevelScatter::expected() const {
  std::vector<double> expected(n_levels_, 0);
  const double mean = first_ + sum_ / n_;
  const double spread = squares_ / n_ - (sum_ / n_) * (sum_ / n_);
  for (std::size_t l = 0; l + 1 < n_levels_; ++l) {
    const std::vector<One>& draws = of_level_[l];
    if (draws.size() < 3) continue;
    const auto n = static_cast<double>(draws.size());
    double middle = 0;
    for (const One& d : draws) middle += d.increment / n;
    std::vector<double> x, y, weight(draws.size(), 1);
    for (const One& d : draws) {
      x.push_back((d.size - mean) * (d.size - mean));
      y.push_back((d.increment - middle) * (d.increment - middle) * n / (n - 1));
    }
    std::array<double, 2> ab{};
    for (int turn = 0; turn < 4; ++turn) {
      ab = fit(x, y, weight);
      const double least = 1e-3 * (ab[0] + ab[1] * spread);
      if (!(least > 0)) break;
      for (std::size_t k = 0; k < x.size(); ++k) {
        const double v = std::max(least, ab[0] + ab[1] * x[k]);
        weight[k] = 1 / (v * v);
      }
    }
    expected[l] = ab[0] + ab[1] * std::max(0.0, spread);
  }
  return expected;
}

}  // namespace sturz
