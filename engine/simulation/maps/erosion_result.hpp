// SPDX-License-Identifier: Apache-2.0
/// What a member's flow took of its bed, in numbers and as a map.
#pragma once

#include "engine/core/ledger.hpp"
#include "engine/effects/state.hpp"
#include "engine/simulation/member_result.hpp"

namespace sturz {

void write_erosion(const BedSupply&, const Ledger&, MemberScalars&);

/// Layer `eroded` over the result's window; empty where the scene takes no bed along.
/// \pre the result has its window
void write_eroded_depth(const State&, MemberResult&);

}  // namespace sturz
