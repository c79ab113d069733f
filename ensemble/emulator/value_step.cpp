// SPDX-License-Identifier: Apache-2.0
#include "ensemble/emulator/value_step.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr std::size_t least_on_a_side = 3;
constexpr double least_share_of_range = 0.2, least_spacings = 3;

/// Mean spacing of some neighbours in a rising list.
double spacing(const std::vector<double>& values, std::size_t first, std::size_t last) {
  return last > first ? (values[last] - values[first]) / static_cast<double>(last - first) : 0;
}

}  // namespace

std::optional<ValueStep> step_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const std::size_t side = std::max(least_on_a_side, (n + 19) / 20);
  if (n < 2 * side) return std::nullopt;
  std::size_t at = side - 1;  // the last below the gap
  for (std::size_t i = side - 1; i + side < n; ++i)
    if (values[i + 1] - values[i] > values[at + 1] - values[at]) at = i;
  const double gap = values[at + 1] - values[at];
  const std::size_t near = std::max(least_on_a_side, n / 8);
  const double apart = std::max(spacing(values, at - std::min(at, near), at),
                                spacing(values, at + 1, std::min(at + 1 + near, n - 1)));
  if (!(gap > 0) || gap < least_share_of_range * (values.back() - values.front()) ||
      gap < least_spacings * std::log(static_cast<double>(n)) * apart)
    return std::nullopt;
  ValueStep step;
  step.below = values[at], step.above = values[at + 1];
  step.least = values.front(), step.most = values.back();
  step.n_below = static_cast<std::int64_t>(at + 1);
  step.n_above = static_cast<std::int64_t>(n - at - 1);
  return step;
}

}  // namespace sturz
