// SPDX-License-Identifier: Apache-2.0
/// Where a member's mass is at its end, measured as the field measures it.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "engine/simulation/parts.hpp"

namespace sturz {

/// Travel of front and centre of mass, fall, and what still moves. What left the known ground
/// counts where it was last seen, so a member whose mass is all gone has come as far as the edge.
/// To be called after max_mean_speed_m_s and front_travel_m are known; works without maps.
void write_travel(const State&, const ReleaseFacts&, MemberScalars&);

/// Crown to toe (L, H, H/L) and front of the deposit, from the deposit layer of `result`; NaN where
/// nothing lies above the runout limit.
///
/// Crown: highest point of the source's surface before it failed (ReleaseFacts). Toe: centre of the
/// deposit's cell that lies farthest from the crown in the map, on the ground as it is at the end.
/// L is the straight horizontal distance between them, H the fall, H / L the tangent of Heim's
/// Fahrboeschung (Heim 1932; Scheidegger 1973, eq. 1; Corominas 1996). It needs no centre of mass,
/// and is larger than the friction that the mass met where the deposit is long.
void write_crown_to_toe(const Terrain& ground, const ReleaseFacts&, double runout_limit_m,
                        MemberResult& result);

}  // namespace sturz
