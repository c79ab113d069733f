// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/wilson.hpp"

#include "engine/core/error.hpp"

#include <cmath>
#include <limits>

namespace sturz {

ProbabilityBounds wilson_interval(std::int64_t hits, std::int64_t trials) {
  expect(hits >= 0 && trials >= hits, "hits lie between 0 and trials");
  if (trials == 0) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan};
  }
  constexpr double z = 1.959963984540054;  // 97.5 % quantile of the standard normal
  const auto k = static_cast<double>(hits), n = static_cast<double>(trials);
  const double middle = (k + z * z / 2) / (n + z * z);
  const double half = z / (n + z * z) * std::sqrt(k * (n - k) / n + z * z / 4);
  // Exact at the ends, where rounding would leave a speck.
  return {hits == 0 ? 0 : middle - half, hits == trials ? 1 : middle + half};
}

}  // namespace sturz
