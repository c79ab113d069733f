// SPDX-License-Identifier: Apache-2.0
/// Grains and liquid as two sets in three dimensions: what they do to each other.
///
/// Brings fields::grain_share and fields::slip_divergence to the liquid, fields::exchange_velocity
/// to the grains, and the passes
///   boundary: pairs across, shares and slip   contact: buoyancy and drag   stress: accounts
/// Shares are found before any set gathers its records, whatever the order in which effects are
/// added. The contact pass takes what the liquid's velocity gained in this step beyond gravity, so
/// the liquid's own contact comes before it and the grains' friction after it.
///
/// Buoyancy, in the form of Anderson & Jackson (1967) in which both share the pressure: the liquid
/// keeps the acceleration a_j that the stress of the mixture gives it, grain i takes
/// omega_i (m_i/rho_p) sum_j b_ij rho_j a_j (shared.hpp). With pair forces on the mixture volumes
/// m_j (1 + X_j)/rho_j the momentum of both sets together is exact. A liquid that does not fill its
/// pores has no pressure; what else pushes it (a neighbour that has one, the ground) lifts the
/// grains by the mass that is there. Drag: each grain and what it meets of the liquid come to rest
/// against each other exponentially (laws/drag.hpp), whatever the step.
#pragma once

#include "engine/effects/coupling/settings.hpp"
#include "engine/effects/step.hpp"

#include <cstddef>

namespace sturz {

/// Adds the liquid's fields: before add_liquid(), which reads them, and before `add_coupling`.
void add_coupling_fields(State&, std::size_t liquid);
/// Adds the passes, after the effects that bring fields::velocity_before to both sets.
/// \param grains,liquid  indices in State::sets
void add_coupling(Step&, State&, std::size_t grains, std::size_t liquid, const CouplingSettings&);

/// Memory of the lists across [bytes per particle].
std::size_t coupling_bytes_per_particle();

}  // namespace sturz
