// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/sample_quantile.hpp"

#include <algorithm>
#include <limits>

namespace sturz {

double sample_quantile(std::span<const float> sorted, std::size_t n_zeros, double fraction) {
  const std::size_t n = sorted.size() + n_zeros;
  if (n == 0) return std::numeric_limits<double>::quiet_NaN();
  const auto x = [&](std::size_t i) { return i < n_zeros ? 0.0 : double{sorted[i - n_zeros]}; };
  const double place = fraction * static_cast<double>(n - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), n - 1);
  const std::size_t above = std::min(below + 1, n - 1);
  return x(below) + (place - static_cast<double>(below)) * (x(above) - x(below));
}

}  // namespace sturz
