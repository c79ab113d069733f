// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/stop_rule.hpp"

#include "engine/core/constants.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

StopRule::StopRule(const StopSettings& settings)
    : settings_(settings),
      window_s_(std::max(settings.spacing_m < 0.2 ? 0.0 : 1.0,
                         5 * std::sqrt(settings.spacing_m / standard_gravity))),
      arming_time_s_(5 * std::sqrt(settings.release_height_m / standard_gravity)) {}

bool StopRule::at_rest(const MotionSummary& now) {
  peak_energy_ = std::max(peak_energy_, now.kinetic_energy_j);
  armed_ |=
      now.time_s > arming_time_s_ || now.kinetic_energy_j > 1e-4 * settings_.available_energy_j;
  if (!armed_ || now.waits ||
      now.kinetic_energy_j >
          settings_.energy_fraction * std::max(peak_energy_, 1e-4 * settings_.available_energy_j)) {
    window_open_ = false;
    return false;
  }
  const double least = 0.1 * settings_.spacing_m, com_least = std::max(least, now.com_m / 400);
  const bool moved = std::abs(now.front_m - window_start_.front_m) > least ||
                     std::abs(now.com_m - window_start_.com_m) > com_least;
  if (!window_open_ || moved) {
    window_open_ = true;
    window_start_ = now;
    return false;
  }
  return now.time_s - window_start_.time_s >= window_s_;
}

}  // namespace sturz
