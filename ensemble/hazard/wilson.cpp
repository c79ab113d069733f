// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/wilson.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {

namespace {

/// Exact at the ends, where rounding would leave a speck.
ProbabilityBounds score_interval(double k, double n, double z) {
  if (!(n > 0) || std::isnan(k)) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan};
  }
  const double middle = (k + z * z / 2) / (n + z * z);
  const double half = z / (n + z * z) * std::sqrt(k * (n - k) / n + z * z / 4);
  return {k <= 0 ? 0 : middle - half, k >= n ? 1 : middle + half};
}

}  // namespace

ProbabilityBounds wilson_interval(std::int64_t hits, std::int64_t trials, double z) {
  expect(hits >= 0 && trials >= hits, "hits lie between 0 and trials");
  return score_interval(static_cast<double>(hits), static_cast<double>(trials), z);
}

ProbabilityBounds wilson_interval_of_share(double share, double effective) {
  expect(!(share < 0) && !(share > 1 + 1e-9), "a share lies between 0 and 1");
  return score_interval(std::min(share, 1.0) * effective, effective, z_95);
}

}  // namespace sturz
