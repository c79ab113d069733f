// SPDX-License-Identifier: Apache-2.0
/// The drift, what leaves the scene, and the extremes that set the next step.
#pragma once

#include "engine/effects/motion/accounts.hpp"
#include "engine/effects/step.hpp"

namespace sturz {

struct MotionSettings {
  double spacing = 1;             ///< initial particle spacing dx [m]
  double smoothing_length = 1.3;  ///< h [m]
};

/// Adds x_{n+1} = x_n + v_{n+1/2} dt, the removal or return of particles off the known terrain,
/// the advection limit 0.25 dx/|v| and the force limit 0.25 sqrt(h/|a|) (docs/physics.md B.12).
void add_motion(Step&, std::size_t set, const MotionSettings&);

}  // namespace sturz
