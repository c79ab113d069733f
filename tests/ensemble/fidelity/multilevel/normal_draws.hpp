// SPDX-License-Identifier: Apache-2.0
/// Standard normal numbers by index.
#pragma once

#include "engine/core/random.hpp"

#include <cmath>
#include <numbers>

namespace sturz::test {

inline double normal(std::uint64_t stream, std::uint64_t i) {
  return std::sqrt(-2 * std::log(unit_random(stream, i, 0))) *
         std::cos(2 * std::numbers::pi * unit_random(stream, i, 1));
}

inline double normal_share(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

}  // namespace sturz::test
