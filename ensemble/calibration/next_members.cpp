// SPDX-License-Identifier: Apache-2.0
#include "ensemble/calibration/next_members.hpp"

#include "ensemble/hazard/weighting/weighted_sample.hpp"

#include <algorithm>

namespace sturz {
namespace {

constexpr std::size_t n_candidates = 256;
constexpr double known_well = 0.01;

/// Emulator's variance over that of all that makes the likelihood wide.
double gain(const Likelihood& likelihood, const EmulatorSet& emulators,
            const std::vector<double>& point) {
  double sum = 0;
  for (std::size_t q = 0; q < emulators.quantities().size(); ++q) {
    const EmulatedValue p = emulators.quantities()[q].at(point);
    const double spread = likelihood.spread(q);
    sum += p.variance / (p.variance + p.noise + spread * spread);
  }
  return sum;
}

}  // namespace

std::vector<std::vector<double>> next_members(const Likelihood& likelihood,
                                              const EmulatorSet& emulators,
                                              const Posterior& posterior, std::size_t n) {
  std::vector<std::vector<double>> candidates, chosen;
  for (const std::size_t i : resampled(posterior.weights, n_candidates))
    candidates.push_back(posterior.cube[i]);
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  EmulatorSet known = emulators;
  while (chosen.size() < n) {
    std::vector<double> gains;
    for (const auto& point : candidates) gains.push_back(gain(likelihood, known, point));
    const auto best = std::max_element(gains.begin(), gains.end());
    if (best == gains.end() || *best < known_well * static_cast<double>(likelihood.n_quantities()))
      break;
    chosen.push_back(candidates[static_cast<std::size_t>(best - gains.begin())]);
    known = known.with_point(chosen.back());
  }
  return chosen;
}

}  // namespace sturz
