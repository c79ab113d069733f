// SPDX-License-Identifier: Apache-2.0
/// The table of an ensemble's members as CSV text.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/scores/score_table.hpp"

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace sturz {

/// One line per finished member in ascending order (RFC 4180 quoting, lines end with \n):
///   member, outcome, reason, formulation, <key>..., <scalar>..., binding_limit, warnings,
///   state_hash (16 hexadecimal digits)
/// and, where members are scored, score_<name>... behind the scalars, and score_bounds: which of
/// them are lower bounds or not known because the member's end was not seen.
/// Numbers are written in the shortest form that reads back to the same bits. A failed or
/// cancelled member has no scalars and no hash: those cells are empty, like a NaN.
/// \param scores rows in the order of `members`; null: none
/// \throws SetupError if a member is not in the design
std::string members_csv(const DesignTable& design, std::span<const MemberSummary> members,
                        const ScoreTable* scores = nullptr);
/// The same in pieces of some hundred kB: of a hundred thousand members it has 100 MB.
void members_csv(const DesignTable& design, std::span<const MemberSummary> members,
                 const ScoreTable* scores, const std::function<void(std::string_view)>& put);

}  // namespace sturz
