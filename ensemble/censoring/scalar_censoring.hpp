// SPDX-License-Identifier: Apache-2.0
/// What a member's scalars still say when its end was not seen: one table.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "ensemble/censoring/censored_quantile.hpp"

#include <span>
#include <vector>

namespace sturz {

/// What is known of one scalar of a member of which mass left the known ground, or still moved at
/// the end. Where both are true the weaker one holds.
struct ScalarCensoring {
  double MemberScalars::*field;
  Known left, moving;
  Phase of = Phase::both;  ///< mass of the other phase that left does not matter
};
/// One row per scalar of scalar_table(), in its order.
///   at_least     what can only grow: farthest, fastest, thickest cell so far; cells reached so far
///   not_at_all   what may go either way: a centre of mass, what lies at the end while it moves
///   exactly      the release, the computation itself
std::span<const ScalarCensoring> scalar_censoring();

/// What is known of a number of which is known `left` where mass left, and `moving` where it still
/// moved.
Known weaker(Known left, Known moving, Censoring censoring);

/// Of a scalar by itself, whatever left. \throws std::logic_error for a scalar without a row
Known known(double MemberScalars::*field, Censoring censoring);
/// Of a member's scalar: those of grains or of liquid by what left of them alone.
Known known(double MemberScalars::*field, const MemberScalars& of, Censoring censoring);

/// One scalar of every valid member.
std::vector<Observation> observations(std::span<const MemberSummary> members,
                                      double MemberScalars::*field);

}  // namespace sturz
