// SPDX-License-Identifier: Apache-2.0
/// Numbers of a mixture of grains and pore fluid in columns.
#pragma once

#include "engine/laws/pore_pressure.hpp"

namespace sturz {

/// Excess pressure inside the columns at nodes, not as a parabola (engine/laws/consolidation.hpp).
struct ProfileSettings {
  int nodes = 0;             ///< 5 to 10; 0: a parabola
  bool drained_bed = false;  ///< not at the free surface only
};

struct MixtureSettings {
  MixtureLaw law;
  double solid_fraction = 0.6;  ///< m at release, saturated and without a film
  /// Pore pressure over total normal stress at release; negative: hydrostatic.
  double pressure_ratio = -1;
  ProfileSettings profile = {};
};

}  // namespace sturz
