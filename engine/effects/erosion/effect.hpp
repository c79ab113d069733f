// SPDX-License-Identifier: Apache-2.0
/// A flow of columns that takes its bed along (docs/physics.md F.8).
///
/// What is taken enters at rest: a column keeps its momentum and loses speed, and what the mixing
/// takes of its kinetic energy is accounted for as such. No law pushes the flow. Columns share what
/// a cell of the ground still has in proportion to what they would take.
#pragma once

#include "engine/effects/erosion/settings.hpp"
#include "engine/effects/step.hpp"

namespace sturz {

/// Field "entrained_mass"; makes State::bed. \pre the set's columns are there, see
/// columns/effect.hpp
void add_erosion(Step&, State&, std::size_t set, const ErosionSettings&);

/// Memory of what a step keeps for each column [bytes].
std::size_t erosion_bytes_per_particle();

/// Growth of its mass above which a column no longer resolves what it stands for.
inline constexpr double unresolved_growth = 10;

}  // namespace sturz
