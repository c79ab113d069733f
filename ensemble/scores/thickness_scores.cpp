// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/thickness_scores.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr int n_bands = 10;

double band_overlap(std::span<const ThicknessPair> measured, double threshold_m) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ThicknessPair& p : measured)
    if (p.observed_m > threshold_m)
      low = std::min(low, p.distance_m), high = std::max(high, p.distance_m);
  if (!(low < high)) return nan_d;
  std::array<double, n_bands + 2> observed{}, simulated{};
  double all_observed = 0, all_simulated = 0;
  for (const ThicknessPair& p : measured) {
    const double at = std::floor((p.distance_m - low) / (high - low) * n_bands);
    // The farthest cell belongs to the last band.
    const double band = p.distance_m == high ? n_bands - 1 : std::clamp(at, -1.0, n_bands + 0.0);
    const auto i = static_cast<std::size_t>(band + 1);
    observed[i] += std::max(0.0, p.observed_m);
    simulated[i] += std::max(0.0, p.simulated_m);
    all_observed += std::max(0.0, p.observed_m);
    all_simulated += std::max(0.0, p.simulated_m);
  }
  double shared = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) shared += std::min(observed[i], simulated[i]);
  return shared / std::max(all_observed, all_simulated);
}

}  // namespace

ThicknessScores thickness_scores(std::span<const ThicknessPair> measured, double threshold_m,
                                 double tolerance_m) {
  double n = 0, squares = 0, sum = 0, near = 0, observed = 0, simulated = 0;
  for (const ThicknessPair& p : measured) {
    observed += p.observed_m;
    simulated += p.simulated_m;
    if (std::abs(p.observed_m) <= threshold_m && std::abs(p.simulated_m) <= threshold_m) continue;
    const double difference = p.simulated_m - p.observed_m;
    ++n;
    squares += difference * difference;
    sum += difference;
    near += std::abs(difference) <= tolerance_m;
  }
  ThicknessScores scores;
  if (n > 0) {
    scores.rmse_m = std::sqrt(squares / n);
    scores.bias_m = sum / n;
    scores.within = near / n;
  }
  if (observed > 0) scores.volume_ratio = simulated / observed;
  scores.band_overlap = band_overlap(measured, threshold_m);
  return scores;
}

}  // namespace sturz
