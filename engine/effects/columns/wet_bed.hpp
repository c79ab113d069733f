// SPDX-License-Identifier: Apache-2.0
/// A saturated bed that a mixture takes along: it brings its own grains, water and pore pressure.
#pragma once

#include "engine/effects/moving_set.hpp"
#include "engine/laws/pore_pressure.hpp"

#include <span>

namespace sturz {

struct SaturatedBed {
  double solid_fraction = 0.64;
  double pressure_ratio = -1;  ///< pore pressure over total normal stress; negative: hydrostatic
  bool drained = false;        ///< it lets go of its excess at once (ProfileSettings)
};

/// Adds this share of so much mass of bed to each column of the mixture, by storage index [kg];
/// mass and velocity of the columns are the caller's.
void take_up(MovingSet&, const MixtureLaw&, const SaturatedBed&, std::span<const double> mass,
             double share);

}  // namespace sturz
