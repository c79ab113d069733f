// SPDX-License-Identifier: Apache-2.0
/// What leaves the scene over the domain boundary, and what a walled boundary stops.
#pragma once

#include "engine/effects/state.hpp"

#include <vector>

namespace sturz {

/// Takes out the particles that State::leaves names, with the kinetic energy they had at the start
/// of the step: the works of this step are accounted for those that stay.
/// \param keep  scratch; \param dt  of the step, whose force on them counts among those of the
/// pairs
void remove_outside(const State&, MovingSet&, std::vector<std::uint8_t>& keep, double dt);

/// A domain boundary that is a wall takes the velocity component that would lead particle i off the
/// known ground within dt. \return kinetic energy per mass that the boundary took, with the mean
/// velocity of the step [J/kg]
double stop_at_domain_boundary(const State&, MovingSet&, std::size_t i, double dt);

}  // namespace sturz
