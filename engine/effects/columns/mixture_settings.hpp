// SPDX-License-Identifier: Apache-2.0
/// Numbers of a mixture of grains and pore fluid in columns.
#pragma once

#include "engine/laws/pore_pressure.hpp"

namespace sturz {

struct MixtureSettings {
  MixtureLaw law;
  double solid_fraction = 0.6;  ///< m at release, saturated and without a film
  /// Pore pressure over total normal stress at release; negative: hydrostatic.
  double pressure_ratio = -1;
};

}  // namespace sturz
