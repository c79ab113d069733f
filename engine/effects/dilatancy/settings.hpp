// SPDX-License-Identifier: Apache-2.0
/// The numbers of grains in full stress that loosen or tighten where they are sheared.
#pragma once

#include "engine/laws/pore_pressure.hpp"

namespace sturz {

struct DilatancySettings {
  /// Only its densities, viscosity, critical fraction and grain diameter (the length delta of N)
  /// are read.
  MixtureLaw law;
  double reference_fraction = 0.6;  ///< of grains where fields::packing_change is 0
  double slope = 1;                 ///< k of tan psi = k (alpha - alpha_eq) [-]
};

}  // namespace sturz
