// SPDX-License-Identifier: Apache-2.0
/// Particles that enter during a run: inflow, entrainment, detachment.
#pragma once

#include "engine/effects/state.hpp"

namespace sturz {

/// Makes particles of a set's arrivals: new ids, fields at their initial values, where they start
/// and what they bring in the ledger. Velocities count as those of the last half step. They stay
/// readable in MovingSet::entering until others enter.
/// \return storage index of the first of them; the others follow
std::size_t enter_arrivals(const Domain&, MovingSet&);

/// Notes where particles [first, size) start; for those that are there from the beginning too.
void mark_start(const Domain&, MovingSet&, std::size_t first);

}  // namespace sturz
