// SPDX-License-Identifier: Apache-2.0
/// Swiss intensity classes of debris flows (physical limits of the federal hazard-map guideline).
#pragma once

namespace sturz {

inline constexpr double swiss_thickness_m = 1;
inline constexpr double swiss_speed_m_s = 1;

/// High: thicker than 1 m and faster than 1 m/s. There is no low class: what is reached and not
/// high is medium.
inline constexpr bool is_high_debris_flow_intensity(double thickness_m, double speed_m_s) {
  return thickness_m > swiss_thickness_m && speed_m_s > swiss_speed_m_s;
}

}  // namespace sturz
