// SPDX-License-Identifier: Apache-2.0
/// Members that do not count alike.
#pragma once

#include "ensemble/hazard/wilson.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sturz {

/// Under so many effective members a weighted result is hardly more than its largest weights.
inline constexpr double least_effective_members = 30;

/// exp(log_weights) over their sum, without overflow.
/// \return [n]; empty when every one is -infinity or NaN: no member explains anything
std::vector<double> normalised_weights(std::span<const double> log_weights);

/// Kish (1965): 1 / sum of squares of weights that add up to 1. n for equal ones, 1 for a single.
double effective_size(std::span<const double> weights);

/// Quantile of values that weigh differently: straight lines between the middles of the steps of
/// the weighted distribution; the least and the largest value beyond the outermost ones. NaN values
/// are left out; NaN when nothing is left. \param fraction in [0, 1]
double weighted_quantile(std::span<const double> values, std::span<const double> weights,
                         double fraction);

struct WeightedShare {
  double share = 0;
  ProbabilityBounds bounds;
};
/// Weighted share of values above a threshold, with Wilson's 95 % interval at the effective size.
WeightedShare weighted_exceedance(std::span<const double> values, std::span<const double> weights,
                                  double threshold);

/// n rows of equal weight in place of weighted ones: systematic resampling (Kitagawa 1996) with
/// steps that start in the middle, so nothing is drawn. A row comes floor or ceil of n w times.
/// \return [n] places, rising
std::vector<std::size_t> resampled(std::span<const double> weights, std::size_t n);

}  // namespace sturz
