// SPDX-License-Identifier: Apache-2.0
/// Results of members that never ran: flows of real size on a large grid, cheap enough to make a
/// hundred thousand of them.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <cstdint>

namespace sturz::test {

/// Member k of an ensemble on edge x edge cells of 5 m, the same at every call: a straight track of
/// 60 to 160 cells with ragged edges, in a window of which it fills three fifths; half of the
/// members start in one place, the others anywhere. On small grids tracks are shorter. Six layers,
/// a history of 120 rows.
MemberResult made_up_flow(std::int64_t member, int edge);

}  // namespace sturz::test
