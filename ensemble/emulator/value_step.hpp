// SPDX-License-Identifier: Apache-2.0
/// Values that jump: a member stops at a bench or runs past it, and no member stops between.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace sturz {

struct ValueStep {
  double below = 0, above = 0;  ///< the nearest values on both sides
  double least = 0, most = 0;   ///< of all
  std::int64_t n_below = 0, n_above = 0;
  double told =
      0;  ///< share of the members whose side the others tell by where they lie; 1 is best

  double middle() const { return below + (above - below) / 2; }
};

/// Values of `n` members that are spread evenly leave gaps of range / n, the largest about ln(n) of
/// that. A step is a gap of a fifth of the range and more, and of more than 3 ln(n) times the mean
/// spacing of the n / 8 (three at least) nearest values on that side where they lie wider apart: a
/// thin tail is no step. A twentieth of the members, three at least, lie on each side. What smooth
/// functions are taken for one is counted in docs/decisions/0034.
/// \param values finite, in any order \return the largest gap if it is a step; `told` is 0
std::optional<ValueStep> step_of(std::vector<double> values);

}  // namespace sturz
