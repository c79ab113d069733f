// SPDX-License-Identifier: Apache-2.0
/// Follows a run at named points and across named lines.
#pragma once

#include "engine/effects/state.hpp"
#include "engine/simulation/gauges/gauge_result.hpp"

#include <string>
#include <vector>

namespace sturz {

struct GaugeSettings {
  struct Point {
    std::string name;
    Vec2 at{0, 0};  ///< [m]
  };
  struct Line {
    std::string name;
    std::vector<Vec2> points;  ///< two or more [m]
  };
  double interval_s = 1;
  double reached_m = 0.05;  ///< thickness from which on a point is reached
  std::vector<Point> points;
  std::vector<Line> lines;
};

/// A point has the thickness that the particles around it spread over it, with the weights of the
/// maps (a quadratic B-spline over one and a half mean distances of columns), at the exact
/// instants: places between two steps are interpolated. A line counts each particle whose way
/// crosses it, whole, at the interpolated time: what passed is exact to a particle, and a discharge
/// is the mean over its interval. Serial and in storage order.
///
/// \pre nothing is periodic
class GaugeRecorder {
 public:
  GaugeRecorder(GaugeSettings, const State&);
  /// To be called after every step.
  void after_step(const State&);
  /// The end of the run: sums, peaks, arrivals, directions.
  GaugeResult finish(const State&);

 private:
  struct Crossed {
    double volume = 0;  ///< from the line's right to its left less the other way [m^3]
    double time_s = 0;
  };
  void follow_lines(const State&, double since);
  void count(std::size_t line, double volume, double time_s);
  void sample(const State&, double time_s, double since);
  void remember(const State&);

  GaugeSettings settings_;
  GaugeResult result_;
  std::vector<std::vector<Crossed>> crossed_;  ///< by line, in the order of steps
  std::vector<double> last_x_, last_y_;        ///< by set and id, at the last step's end [m]
  std::vector<std::size_t> first_of_set_;      ///< in these
  double last_s_ = 0;
};

}  // namespace sturz
