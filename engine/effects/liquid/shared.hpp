// SPDX-License-Identifier: Apache-2.0
/// What the passes of a liquid hold together.
#pragma once

#include "engine/effects/dense/sweep_arrays.hpp"
#include "engine/effects/liquid/settings.hpp"
#include "engine/effects/step.hpp"

#include <memory>

namespace sturz {

struct LiquidFlow : SweepArrays {
  LiquidSettings settings;

  LiquidFlow(std::size_t set_index, const LiquidSettings& s)
      : SweepArrays(set_index, s.smoothing_length, s.skin, s.instruction_set), settings(s) {}
};

/// Lets c0 follow the flow. \param planned  c0 of the whole descent [m/s]
void add_liquid_sound_speed(Step&, const std::shared_ptr<LiquidFlow>&, double planned);

}  // namespace sturz
