// SPDX-License-Identifier: Apache-2.0
/// Columns that wait for their time to enter.
#pragma once

#include "engine/effects/moving_set.hpp"

#include <vector>

namespace sturz {

struct TimedArrival {
  double time_s = 0;
  /// Of an inflow: its velocity points the way in the map and has the speed along the ground; its
  /// height is that of the ground where it enters.
  Arrival arrival;
};

struct InflowSettings {
  std::vector<TimedArrival> columns;  ///< in the order of their times
  /// Longest step over which a release may start: as short as the first step of a run.
  double start_dt_s = 0.01;
};

}  // namespace sturz
