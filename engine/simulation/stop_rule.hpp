// SPDX-License-Identifier: Apache-2.0
/// When a member is over: kinetic energy spent, front and centre of mass at rest.
#pragma once

namespace sturz {

struct StopSettings {
  double end_time_s = 120;
  bool stop_at_rest = true;
  double spacing_m = 1;           ///< dx
  double release_height_m = 1;    ///< H: arms after 5 sqrt(H/g)
  double available_energy_j = 1;  ///< arms when kinetic energy has passed 1e-4 of it
  double energy_fraction = 0.01;  ///< of the peak kinetic energy: at rest there is no more
};

/// What the rule looks at.
struct MotionSummary {
  double time_s = 0;
  double kinetic_energy_j = 0;
  double front_m = 0;  ///< farthest horizontal displacement of a particle
  double com_m = 0;    ///< horizontal displacement of the centre of mass
  bool waits = false;  ///< mass is still to enter: nothing is at rest
};

/// At rest: kinetic energy below a share of its peak (1 %, as in the practice of snow avalanches),
/// and over a window of 5 sqrt(dx/g) (at least 1 s at field scale, dx >= 0.2 m) the front moved
/// less than dx/10 and the centre of mass less than dx/10 or a 400th of its travel. Particle
/// solvers creep at millimetres per second (F.4), and tails of masses with turbulent friction drain
/// for minutes behind a front that stands: neither moves the whole by much. The bound on the centre
/// of mass keeps a main mass that follows a lost boulder at a tenth of the peak speed from being
/// cut.
class StopRule {
 public:
  explicit StopRule(const StopSettings&);
  /// Whether the mass is at rest now, be it the end or not. To be fed with ascending times.
  bool at_rest(const MotionSummary&);
  bool stops_at_rest() const { return settings_.stop_at_rest; }
  bool out_of_time(double time_s) const { return time_s >= settings_.end_time_s; }
  double end_time_s() const { return settings_.end_time_s; }

 private:
  StopSettings settings_;
  double peak_energy_ = 0;
  double window_s_, arming_time_s_;
  bool armed_ = false, window_open_ = false;
  MotionSummary window_start_;
};

}  // namespace sturz
