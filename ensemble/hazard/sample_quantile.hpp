// SPDX-License-Identifier: Apache-2.0
/// Quantiles of a few numbers, many of which may be zero.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace sturz {

/// Where a quantile lies among n > 0 order statistics, by definition 7 of Hyndman & Fan (1996).
struct QuantilePlace {
  std::size_t below = 0, above = 0;  ///< the two between which it lies
  double share = 0;                  ///< of the way from the one to the other

  QuantilePlace(std::size_t n, double fraction) {
    const double place = fraction * static_cast<double>(n - 1);
    below = std::min(static_cast<std::size_t>(place), n - 1);
    above = std::min(below + 1, n - 1);
    share = place - static_cast<double>(below);
  }
  double between(double lower, double upper) const { return lower + share * (upper - lower); }
};

/// Quantile of a sample made of `n_zeros` zeros and `sorted` (ascending, none negative): linear
/// between order statistics x_0 .. x_{n-1}, which lie at fractions i / (n - 1) (definition 7 of
/// Hyndman & Fan 1996). NaN for an empty sample.
/// \param fraction in [0, 1]
double sample_quantile(std::span<const float> sorted, std::size_t n_zeros, double fraction);

}  // namespace sturz
