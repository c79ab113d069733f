// SPDX-License-Identifier: Apache-2.0
/// Where a member's mass is at its end, measured as the field measures it.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "engine/simulation/parts.hpp"

#include <span>
#include <string>
#include <vector>

namespace sturz {

/// Travel of front and centre of mass, fall, and what still moves. What left the known ground
/// counts where it was last seen, so a member whose mass is all gone has come as far as the edge.
/// To be called after max_mean_speed_m_s and front_travel_m are known; works without maps.
void write_travel(const State&, const ReleaseFacts&, MemberScalars&);

/// Crown to toe (L, H, H/L) and front of the deposit; NaN without a deposit.
///
/// Crown: highest point of the source's surface before it failed (ReleaseFacts). Toe: centre of the
/// deposit's cell that lies farthest from the crown in the map, on the ground as it is at the end.
/// L is the straight horizontal distance between them, H the fall, H / L the tangent of Heim's
/// Fahrboeschung (Heim 1932; Scheidegger 1973, eq. 1; Corominas 1996). It needs no centre of mass,
/// and is larger than the friction that the mass met where the deposit is long.
/// Mass that left counts where it was last seen: L and front are then at least that far, while H
/// and H / L, which need the toe, are NaN where it lies beyond the edge. \param deposit  cells of
/// `grid` that the deposit covers \param left     where mass was last seen before it left the known
/// ground
void write_crown_to_toe(const Terrain& ground, const ReleaseFacts&,
                        std::span<const PeakMaps::Cell> deposit, std::span<const Vec2> left,
                        const Grid& grid, MemberScalars&);
/// From the release's centre of mass to the farthest reached cell [m]; zero where none is.
double runout_of(const MemberResult&, const ReleaseFacts&);
/// Of all that is still there [kg].
double mass_on_terrain(const State&);
/// The places of write_crown_to_toe.
std::vector<Vec2> places_left(const State&);

/// What a reader of the member has to doubt, one sentence each:
/// - Detachment: more than 1 % of mass times time is on ground that curves away faster than the
/// mass
///   falls. Columns cannot leave the ground, so where they would fly and land is not computed; the
///   share is the part of the flow that it concerns.
/// - Energy: more than 5 % of the released energy is in no account, which is as much as friction
///   wrong by 5 % and above all that the verification cases leave (1e-5). A spike in the terrain is
///   enough. Not told of a mass that hardly fell: the rest must be worth a hundredth of a spacing.
std::vector<std::string> doubts(const MemberScalars&, const Ledger&, double spacing_m);

}  // namespace sturz
