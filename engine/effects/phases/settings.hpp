// SPDX-License-Identifier: Apache-2.0
/// Numbers of grains and liquid as two sets of columns.
#pragma once

#include "engine/effects/columns/settings.hpp"
#include "engine/laws/phase_drag.hpp"

namespace sturz {

struct TwoPhaseSettings {
  /// Each with its own material's density, so that thicknesses are volumes of that material over
  /// area, and its own bed: the grains' Coulomb friction, the liquid's viscous and turbulent drag.
  DepthAveragedSettings grains, liquid;
  PhaseDrag drag;
  /// Share of grains in their densest packing: liquid that fills its pores carries the grains'
  /// whole buoyancy, less carries less.
  double densest_fraction = 0.68;
};

}  // namespace sturz
