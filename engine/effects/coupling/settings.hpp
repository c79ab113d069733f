// SPDX-License-Identifier: Apache-2.0
/// The numbers of what grains and liquid in three dimensions do to each other.
#pragma once

namespace sturz {

struct CouplingSettings {
  double grain_density = 2600;   ///< rho_p of a grain [kg/m^3]
  double liquid_density = 1000;  ///< rho_0 of the liquid [kg/m^3]
  double viscosity = 0.001;      ///< mu_f that the grains feel [Pa s]
  double drag_diameter = 0.01;   ///< d of the drag: of the fines that set the permeability [m]
  double drag_multiplier = 1;    ///< on the drag; 1 is physics
  /// Grains take their share of the liquid's pressure. Without it, as in the paper, they still take
  /// room in the liquid, and what its pressure should do to them is lost: momentum is not kept.
  bool buoyancy = true;
  double smoothing_length = 1.3;  ///< h of the weights between the two sets [m]
  double spacing = 1;             ///< of the grains [m]
  double courant = 0.25;          ///< dt <= courant h/(c + |v|), c of laws/mixture_sound.hpp
  double shear_stiffness = 0.25;  ///< of the liquid, LiquidSettings::shear_stiffness [-]
  double skin = 0.2;              ///< of the lists across, in smoothing lengths

  static constexpr double least_fraction = 0.02;  ///< alpha_p of a grain's own volume
  static constexpr double most_fraction = 0.8;
  /// X of grains in a liquid particle: pores of a tenth.
  static constexpr double largest_share = 9;
  static constexpr double largest_fraction() { return largest_share / (1 + largest_share); }
  /// Share of a grain's support that liquid must fill for the grain to count as wet all over; under
  /// that, what they do to each other fades with the share.
  static constexpr double wet_support = 0.5;
};

}  // namespace sturz
