// SPDX-License-Identifier: Apache-2.0
/// Grains that separate and meet again: states of the grains, and kinetic theory of those that
/// collide.
#pragma once

#include "engine/effects/step.hpp"

#include <memory>

namespace sturz {

struct GrainStress;

/// Adds granular temperature and the stress of collisions (`grains.states.dilute`): the fields
/// `granular_temperature` and `kinetic_stress`. Before add_grain_states.
void add_kinetic_theory(Step&, State&, const std::shared_ptr<GrainStress>&);

/// Adds kinetic records and the names of the states: the fields `state` and `support_completeness`.
void add_grain_states(Step&, State&, const std::shared_ptr<GrainStress>&);

}  // namespace sturz
