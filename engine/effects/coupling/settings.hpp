// SPDX-License-Identifier: Apache-2.0
/// The numbers of what grains and liquid in three dimensions do to each other.
#pragma once

namespace sturz {

struct CouplingSettings {
  double grain_density = 2600;    ///< rho_p of a grain [kg/m^3]
  double liquid_density = 1000;   ///< rho_0 of the liquid [kg/m^3]
  double viscosity = 0.001;       ///< mu_f that the grains feel [Pa s]
  double drag_diameter = 0.01;    ///< d of the drag: of the fines that set the permeability [m]
  double drag_multiplier = 1;     ///< on the drag; 1 is physics
  bool buoyancy = true;           ///< grains take their share of the liquid's pressure
  double smoothing_length = 1.3;  ///< h of the weights between the two sets [m]
  double spacing = 1;             ///< of the grains [m]
};

}  // namespace sturz
