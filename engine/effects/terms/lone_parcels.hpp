// SPDX-License-Identifier: Apache-2.0
/// Grains that have lost their neighbours leave the continuum and fly; those that land in it come
/// back (physics.md B.8, B.9). Mass, position and velocity stay: only the name changes.
#pragma once

#include "engine/effects/state.hpp"
#include "engine/effects/terms/grain_stress_shared.hpp"

namespace sturz {

/// Value of the field "steps_alone" of a parcel in flight.
inline constexpr double in_flight = 100;

/// Lets those go that were alone for `detach_steps` steps: their stress is gone, what it stored and
/// their granular energy are booked. \return whether anybody went
bool detach_lone(State&, const GrainStressSettings&);

/// Puts the grains of the continuum first in storage and sets State::n_listed.
void put_listed_first(State&);

/// Takes back parcels that have come among at least `attach_neighbors` grains that fill more than
/// `attach_fraction`, with the granular temperature found there. Lists must be fresh.
/// \return whether anybody came
bool attach_near(State&, const GrainStressSettings&, const NeighborLists&);

}  // namespace sturz
