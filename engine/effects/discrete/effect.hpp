// SPDX-License-Identifier: Apache-2.0
/// Every particle a grain: spheres that press, rub and roll on each other, on ground and walls.
#pragma once

#include "engine/effects/discrete/settings.hpp"
#include "engine/effects/step.hpp"

namespace sturz {

/// Adds pairs and contacts of all particles of a set, each a sphere of its own mass and the
/// material's density, with the fields "spin" [rad/s] and what their predictions need. The ground
/// is looked up before by add_ground_lookup; gravity and the drift are those of all particles.
///
/// Forces at x_n act on v_{n-1/2} -> v_{n+1/2} in one kick; dampers see velocities predicted for
/// x_n: second order while contacts last, 5/4 where they begin and end. What overlaps when a run
/// starts carries nothing until it has opened: setting grains down sets no energy free.
///
/// Ledger: elastic (springs), rotational (spins), plastic (slip and roll between grains), friction
/// (slip and roll on the bed and walls), collisions (dampers); stress_work is the work of all
/// contact forces on motion and spin, stress_power what was stored or dissipated of it, so
/// `numerical` is what the integration in time misses.
void add_discrete_grains(Step&, State&, std::size_t set, const DiscreteSettings&);

/// Memory besides the set's own fields: pairs and their forces [bytes per particle].
std::size_t discrete_bytes_per_particle();

}  // namespace sturz
