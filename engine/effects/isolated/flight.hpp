// SPDX-License-Identifier: Apache-2.0
/// Grains that have lost their neighbours leave the continuum and fly; those that land in it come
/// back (docs/physics.md B.8, B.9). Mass, position and velocity stay: only the name changes.
#pragma once

#include "engine/effects/dense/shared.hpp"
#include "engine/effects/isolated/search.hpp"
#include "engine/effects/state.hpp"

namespace sturz {

/// Detaches grains that were alone for `detach_steps` steps: their stress is gone, what it stored
/// and their granular energy are accounted for. \return whether a particle left
bool detach_isolated(MovingSet&, const GrainStressSettings&);

/// Takes back what has landed, as dense grains without load.
void attach_landed(MovingSet&);

/// Puts the grains of the continuum first in storage and sets MovingSet::n_listed.
void put_listed_first(MovingSet&);

/// Takes back isolated particles that have at least `attach_neighbors` neighbours, listed or
/// isolated, that fill more than `attach_fraction`, with the granular temperature of the grains
/// found there. Lists must be fresh. \return whether a particle rejoined
bool attach_near(const Domain&, MovingSet&, const GrainStressSettings&, const NeighborLists&,
                 IsolatedSearch&);

}  // namespace sturz
