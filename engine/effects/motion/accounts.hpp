// SPDX-License-Identifier: Apache-2.0
/// What every step ends with: works and extremes of the motion.
#pragma once

#include "engine/effects/state.hpp"

namespace sturz {

/// Fills the ledger's kinetic energy and works and the motion bounds; dt = 0 before the first step.
void refresh_motion(const State&, MovingSet&, double dt);

}  // namespace sturz
