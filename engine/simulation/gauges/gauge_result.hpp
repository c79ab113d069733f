// SPDX-License-Identifier: Apache-2.0
/// What gauges of a member have seen: points and lines that the user names.
#pragma once

#include "engine/core/vec.hpp"

#include <limits>
#include <string>
#include <vector>

namespace sturz {

/// The largest value over time and when it was there first; NaN, NaN where nothing came.
struct GaugePeak {
  double value = std::numeric_limits<double>::quiet_NaN();
  double time_s = std::numeric_limits<double>::quiet_NaN();
};

/// At one point, as many instants as GaugeResult::time_s has.
struct PointSeries {
  std::string name;
  Vec2 at{0, 0};                                                ///< [m]
  std::vector<float> thickness_m;                               ///< vertical
  std::vector<float> speed_m_s;                                 ///< of the mean momentum there
  std::vector<float> momentum_flux_n_m;                         ///< rho h v^2
  double arrival_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: never reached
  GaugePeak thickness, speed, momentum_flux;
};

/// Across one line.
struct LineSeries {
  std::string name;
  std::vector<Vec2> points;  ///< [m]
  /// Passed by then, in the direction in which most passed in the end, less what came back.
  std::vector<double> volume_m3;
  /// Mean since the instant before; the first is zero.
  std::vector<double> discharge_m3_s;
  double arrival_s = std::numeric_limits<double>::quiet_NaN();  ///< of the first column
  double total_m3 = 0;                                          ///< exact, at the end
  GaugePeak discharge;
};

struct GaugeResult {
  double interval_s = 0;
  std::vector<double> time_s;  ///< multiples of the interval, and the end
  std::vector<PointSeries> points;
  std::vector<LineSeries> lines;
  bool empty() const { return points.empty() && lines.empty(); }
};

}  // namespace sturz
