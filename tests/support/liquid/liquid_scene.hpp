// SPDX-License-Identifier: Apache-2.0
/// Liquid in three dimensions on even ground, made by hand: the engine's own passes and nothing of
/// scenario files.
#pragma once

#include "engine/effects/liquid/settings.hpp"
#include "engine/simulation/simulation.hpp"
#include "tests/support/hand_made.hpp"

#include <array>
#include <functional>
#include <vector>

namespace sturz::test {

/// A box of liquid on a cubic lattice, standing on the ground z = 0.
struct LiquidBox {
  double spacing = 0.1;             ///< [m]
  std::array<int, 3> n{10, 4, 10};  ///< particles along x, y, z
  Vec3 corner{0, 0, 0};             ///< the least x, y, z [m]
  /// In the place of the lattice: the particles themselves, under a free surface at `top`.
  std::vector<Vec3> at = {};
  double top = 0;                ///< [m]
  Vec3 velocity{0, 0, 0};        ///< [m/s]
  double slope = 0;              ///< the ground falls by it per metre eastward
  bool along_slope = false;      ///< layers along the ground and normal to it, else plumb
  double half_width = 10;        ///< of the ground around x = y = 0 [m]
  double cell = 0;               ///< of the ground [m]; 0: twice the spacing
  LiquidSettings settings = {};  ///< spacing and lengths follow from `spacing`
  double gravity = standard_gravity;
  LiquidBed bed = LiquidBed::slip;
  bool walls_hold = false;
  Domain domain = {};
  /// z of the ground at x, y; empty: the even ground of `slope`.
  std::function<double(double, double)> ground = {};
  InstructionSet instruction_set = best_instruction_set();
  bool hydrostatic = true;  ///< starts under its own weight, else without pressure
  int threads = 1;
};

/// Gravity, ground, walls, liquid, motion.
HandMade liquid_of(const LiquidBox&);
/// The same with the bookkeeping of a run.
Simulation simulation_of(const LiquidBox&, double end_time_s);

}  // namespace sturz::test
