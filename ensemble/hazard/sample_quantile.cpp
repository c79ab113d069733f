// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/sample_quantile.hpp"

#include <limits>

namespace sturz {

double sample_quantile(std::span<const float> sorted, std::size_t n_zeros, double fraction) {
  const std::size_t n = sorted.size() + n_zeros;
  if (n == 0) return std::numeric_limits<double>::quiet_NaN();
  const auto x = [&](std::size_t i) { return i < n_zeros ? 0.0 : double{sorted[i - n_zeros]}; };
  const QuantilePlace place(n, fraction);
  return place.between(x(place.below), x(place.above));
}

}  // namespace sturz
