// SPDX-License-Identifier: Apache-2.0
/// Members put together from the engine's own effects, without the scenarios' assemble: what a
/// scene would cost if nothing but the effects it calls for had ever been written.
#pragma once

#include "engine/effects/state.hpp"
#include "engine/effects/step.hpp"
#include "scenarios/assembly/scene_plan.hpp"

namespace sturz::bench {

struct ByHand {
  State state;
  Step step;
};

/// Grain stress, gravity, terrain contact and motion; or columns, where the plan is of columns.
/// \param plan without zones and walls
ByHand by_hand(const ScenePlan& plan);

}  // namespace sturz::bench
