// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/weighting/weighted_sample.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sturz {

std::vector<double> normalised_weights(std::span<const double> log_weights) {
  double most = -std::numeric_limits<double>::infinity();
  for (const double l : log_weights)
    if (l > most) most = l;
  if (!std::isfinite(most)) return {};
  std::vector<double> weights;
  for (const double l : log_weights) weights.push_back(std::isnan(l) ? 0 : std::exp(l - most));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w /= sum;
  return weights;
}

double effective_size(std::span<const double> weights) {
  double sum = 0, squares = 0;
  for (const double w : weights) {
    sum += w;
    squares += w * w;
  }
  return squares > 0 ? sum * sum / squares : 0;
}

double weighted_quantile(std::span<const double> values, std::span<const double> weights,
                         double fraction) {
  expect(values.size() == weights.size(), "one weight per value");
  std::vector<std::size_t> order;
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i]) && weights[i] > 0) {
      order.push_back(i);
      sum += weights[i];
    }
  if (order.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  double passed = 0, place_before = 0, value_before = values[order.front()];
  for (const std::size_t i : order) {
    const double place = (passed + weights[i] / 2) / sum;
    if (place >= fraction) {
      if (i == order.front() || place == place_before) return values[i];
      return value_before +
             (values[i] - value_before) * (fraction - place_before) / (place - place_before);
    }
    passed += weights[i];
    place_before = place;
    value_before = values[i];
  }
  return value_before;
}

WeightedShare weighted_exceedance(std::span<const double> values, std::span<const double> weights,
                                  double threshold) {
  expect(values.size() == weights.size(), "one weight per value");
  double above = 0, sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += weights[i];
    if (values[i] > threshold) above += weights[i];
  }
  const double share = sum > 0 ? above / sum : std::numeric_limits<double>::quiet_NaN();
  return {share, wilson_interval_of_share(share, effective_size(weights))};
}

std::vector<std::size_t> resampled(std::span<const double> weights, std::size_t n) {
  std::vector<std::size_t> places;
  if (weights.empty()) return places;
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  double passed = weights.front();
  std::size_t i = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double step = (static_cast<double>(k) + 0.5) / static_cast<double>(n) * sum;
    while (passed < step && i + 1 < weights.size()) passed += weights[++i];
    places.push_back(i);
  }
  return places;
}

}  // namespace sturz
