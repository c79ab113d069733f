// SPDX-License-Identifier: Apache-2.0
/// Grains and liquid as two sets in three dimensions: what they do to each other.
///
/// Brings fields::grain_share and fields::slip_divergence to the liquid, and the passes
///   neighbors: lists across   gather: shares and slip   contact: buoyancy and drag
/// The contact pass takes what the liquid's velocity gained in this step beyond gravity, so the
/// liquid's own contact comes before it and the grains' friction after it.
#pragma once

#include "engine/effects/coupling/settings.hpp"
#include "engine/effects/step.hpp"

#include <cstddef>

namespace sturz {

/// Adds the liquid's fields: before add_liquid(), which reads them, and before `add_coupling`.
void add_coupling_fields(State&, std::size_t liquid);
/// Adds the passes. \param grains,liquid  indices in State::sets
void add_coupling(Step&, State&, std::size_t grains, std::size_t liquid, const CouplingSettings&);

/// Memory of the lists across [bytes per particle].
std::size_t coupling_bytes_per_particle();

}  // namespace sturz
