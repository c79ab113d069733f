// SPDX-License-Identifier: Apache-2.0
/// Swiss intensity classes of debris flows (physical limits of the federal hazard-map guideline).
#pragma once

namespace sturz {

inline constexpr double swiss_thickness_m = 1;
inline constexpr double swiss_speed_m_s = 1;

/// High: thicker than 1 m and faster than 1 m/s. There is no low class: what is reached and not
/// high is medium.
template <class Number>
constexpr bool is_high_debris_flow_intensity(Number thickness_m, Number speed_m_s) {
  // Both limits are exact in any kind of number.
  return (thickness_m > Number{swiss_thickness_m}) & (speed_m_s > Number{swiss_speed_m_s});
}

}  // namespace sturz
