// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/weighting/weighted_quantile.hpp"

#include <algorithm>
#include <limits>

namespace sturz {

double weighted_map_quantile(std::span<const WeighedValue> sorted, double zero_weight,
                             double effective, double fraction) {
  double total = zero_weight;
  for (const WeighedValue& v : sorted) total += v.weight;
  if (!(total > 0)) return std::numeric_limits<double>::quiet_NaN();
  const double n = std::max(effective, 1.0);
  const double from = fraction * (n - 1) / n, to = from + 1 / n;
  const auto inside = [&](double low, double high) {
    return std::max(0.0, std::min(high, to) - std::max(low, from));
  };
  double passed = zero_weight / total;
  double covered = inside(0, passed), sum = 0;  // zeros add nothing
  for (const WeighedValue& v : sorted) {
    const double next = passed + v.weight / total;
    const double part = inside(passed, next);
    covered += part;
    sum += part * v.value;
    passed = next;
  }
  // Less than the window by rounding only, where it ends with the sample.
  return covered > 0 ? sum / covered : sorted.empty() ? 0.0 : double{sorted.back().value};
}

}  // namespace sturz
