// SPDX-License-Identifier: Apache-2.0
/// Whole-number maps as files keep them: int32, with one value for "undefined".
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace sturz {

inline constexpr std::int32_t no_count = std::numeric_limits<std::int32_t>::min();

/// \param value a whole number, or NaN
inline std::int32_t stored_count(float value) {
  return std::isnan(value) ? no_count : static_cast<std::int32_t>(std::lround(value));
}

}  // namespace sturz
