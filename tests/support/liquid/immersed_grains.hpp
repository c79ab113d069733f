// SPDX-License-Identifier: Apache-2.0
/// Grains in a liquid on level ground, made by hand: two boxes on one lattice, the liquid's larger
/// or the same, in a slice that repeats itself along y.
#pragma once

#include "engine/effects/coupling/settings.hpp"
#include "engine/effects/dense/settings.hpp"
#include "engine/effects/dilatancy/settings.hpp"
#include "engine/effects/liquid/settings.hpp"
#include "tests/support/hand_made.hpp"

#include <optional>

namespace sturz::test {

struct ImmersedGrains {
  double spacing = 0.1;                           ///< [m]
  double grain_length = 0.4, grain_height = 1;    ///< of the grains' box [m]
  double liquid_length = 0.4, liquid_height = 1;  ///< of the liquid's [m]
  int across = 4;                                 ///< particles along y
  double solid_fraction = 0.6;
  double grain_density = 2600, liquid_density = 1000;  ///< [kg/m^3]
  double viscosity = 0.001;                            ///< [Pa s]
  double drag_diameter = 1e-3;                         ///< [m]
  double sound_speed = 30;                             ///< of both sets [m/s]
  double grain_sound_speed = 0;                        ///< of the grains alone; 0: the same [m/s]
  double gravity = standard_gravity;                   ///< [m/s^2]
  double friction = 0.5;                               ///< of the bed
  double grain_friction = MuIRheology{}.static_friction;  ///< mu_s; 10 and more: grains never yield
  double drag_multiplier = 1;
  double reach = 0;     ///< of the ground beyond the longer box [m]
  bool walled = false;  ///< walls at x = 0 and the liquid's end, else x repeats itself
  /// Share of the grains' submerged weight that the pore pressure bears at the start.
  double liquefied = 0;
  std::optional<DilatancySettings> dilatancy = {};
  bool coupled = true;   ///< else each set is alone in its place
  bool buoyancy = true;  ///< CouplingSettings::buoyancy
  Vec3 slip{0, 0, 0};    ///< velocity of the grains at the start [m/s]
  int threads = 1;
};

/// Set 0 are the grains, set 1 is the liquid.
HandMade immersed(const ImmersedGrains&);

/// Pressure of the liquid beyond that of still liquid under the surface it started with, mean of
/// the particles between two heights [Pa].
double excess_pressure(const State&, const ImmersedGrains&, double from_height, double to_height);

}  // namespace sturz::test
