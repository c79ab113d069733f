// SPDX-License-Identifier: Apache-2.0
/// Where the mass of an ensemble lay at its start.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <cstdint>

namespace sturz {

/// Cells that the first few valid members cover at time 0 are 1, others 0, on the smallest part of
/// the members' grid that holds them; no cells without members. The same for every ensemble whose
/// release has one outline; where it varies, all outlines joined.
Raster<std::uint8_t> release_footprint(const MemberSource& members, int n_looked_at = 4);

}  // namespace sturz
