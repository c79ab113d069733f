// SPDX-License-Identifier: Apache-2.0
/// Grains computed one by one: plain data of the block `grains.discrete`; formulation: discrete
/// only.
#pragma once

#include "scenarios/uncertain.hpp"

#include <optional>

namespace sturz {

struct DiscreteSpec {
  std::optional<Uncertain> diameter_m;  ///< of the grains that are computed; absent: of `grains`
  double size_spread = 0.1;             ///< diameters lie evenly within 1 +- this
  double youngs_modulus_pa = 5e10;      ///< at most; softened to the speeds of the scene
  double greatest_overlap = 0.1;        ///< of an impact at the expected speed, over the radius
  Uncertain restitution{0.5};           ///< of two grains; the bed has its own
  Uncertain friction_coefficient{0.5};  ///< of two grains
  Uncertain rolling_friction{0.1};      ///< of two grains
  std::optional<Uncertain> bed_rolling_friction;  ///< absent: the bed's friction coefficient
  bool operator==(const DiscreteSpec&) const = default;
};

}  // namespace sturz
