// SPDX-License-Identifier: Apache-2.0
/// How far the mass has come from where it started, and how fast its front and tail are.
#pragma once

#include <vector>

namespace sturz {

struct State;

/// Where the mass is relative to where it started, and how fast.
struct Displacement {
  double front = 0;  ///< farthest particle, horizontal [m]
  /// Centre of mass, horizontal; mass that was taken up counts from where that was [m].
  double com = 0;
  double mean_speed = 0;  ///< mass average [m/s]
  double high_speed = 0;  ///< 99.9 % of the particles are slower [m/s]
  double lowest = 0;      ///< elevation of the lowest particle [m]
};

/// Displacement of one particle since the start.
struct ParticleTravel {
  double displacement2 = 0;  ///< horizontal displacement squared [m^2]
  double speed = 0;          ///< [m/s]
  double mass = 0;           ///< [kg]
};

/// Looks at all particles; whole periods count. \param each  is filled anew, in no order
Displacement measure(const State&, std::vector<ParticleTravel>& each);

struct FrontAndTail {
  double front_speed = 0;  ///< mean of the foremost 1 % of the mass [m/s]
  double tail_speed = 0;   ///< mean of the rearmost 1 % of the mass [m/s]
  double tail_travel = 0;  ///< that 5 % of the mass have not passed [m]
};
/// Foremost are the particles that have come farthest, rearmost those that have come least far; at
/// least one particle each. Takes time in proportion to their number. \param each  is put into
/// another order
FrontAndTail front_and_tail(std::vector<ParticleTravel>& each);

}  // namespace sturz
