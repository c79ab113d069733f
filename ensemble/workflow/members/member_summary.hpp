// SPDX-License-Identifier: Apache-2.0
/// What is kept in memory of a member that was computed: all but its maps.
#pragma once

#include "engine/simulation/member_result.hpp"

namespace sturz::workflow {

inline MemberSummary summary_of(const MemberResult& r) {
  return {r.member,   r.outcome,    r.censoring, r.reason, r.formulation,   r.binding_limit,
          r.warnings, r.state_hash, r.scalars,   r.window, r.effect_seconds};
}

}  // namespace sturz::workflow
