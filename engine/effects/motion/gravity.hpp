// SPDX-License-Identifier: Apache-2.0
/// Gravity, and the kick that turns accelerations into velocities.
#pragma once

#include "engine/effects/step.hpp"

namespace sturz {

/// Adds the kick pass; pair forces are expected in State::ax..az (zero when no effect writes them).
void add_gravity(Step&, State&, std::size_t set);

}  // namespace sturz
