// SPDX-License-Identifier: Apache-2.0
/// Grains that lost their neighbours leave the continuum, fly on their own and come back.
#pragma once

#include "engine/effects/step.hpp"

#include <memory>

namespace sturz {

struct GrainStress;

/// Adds the fields `steps_alone` and `membership`, the count of steps without neighbours, and the
/// changes of membership whenever neighbours are sorted. After add_grain_states.
void add_isolated_particles(Step&, State&, const std::shared_ptr<GrainStress>&);

}  // namespace sturz
