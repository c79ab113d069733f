// SPDX-License-Identifier: Apache-2.0
/// What leaves the scene over the rim of the known ground, and what the rim stops.
#pragma once

#include "engine/effects/state.hpp"

#include <vector>

namespace sturz {

/// Takes out the particles that State::leaves names, with the kinetic energy they had at the start
/// of the step: the works of this step are booked for those that stay.
/// \param keep  scratch
void remove_outside(const State&, MovingSet&, std::vector<std::uint8_t>& keep);

/// A rim that is a wall takes the velocity component that would lead particle i off the known
/// ground within dt.
/// \return kinetic energy per mass that the rim took, with the mean velocity of the step [J/kg]
double stop_at_rim(const State&, MovingSet&, std::size_t i, double dt);

}  // namespace sturz
