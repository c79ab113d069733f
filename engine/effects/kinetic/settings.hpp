// SPDX-License-Identifier: Apache-2.0
/// The numbers of the states that grains pass through when they separate (A.4, A.7, B.9).
#pragma once

#include "engine/laws/frictional_pressure.hpp"
#include "engine/laws/kinetic_theory.hpp"

#include <optional>

namespace sturz {

struct GrainStatesSettings {
  double reference_fraction = 0.6;  ///< alpha_ref = max(0.60, alpha_init): where p = K e begins
  /// alpha_init where it is less: grains that a liquid carries start dilated, and bear no more than
  /// the frictional pressure of that packing.
  std::optional<double> loose_fraction;
  FrictionalPressure friction;          ///< of the transition
  std::optional<KineticTheory> dilute;  ///< absent: dilated grains do not collide
  bool ultradilute = false;             ///< isolated grains leave the continuum and fly
  /// Gao et al. sections 3.2 and 4.2: elastic pressure in the dense state, Eq. (23) alone in the
  /// transition, kinetic theory alone below; pressure relaxes to it within 10 h/c0.
  bool paper_switch = false;
};

}  // namespace sturz
