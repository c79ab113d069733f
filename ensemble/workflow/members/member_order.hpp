// SPDX-License-Identifier: Apache-2.0
/// In which order the members of an ensemble start.
#pragma once

#include "ensemble/workflow/members/ensemble_job.hpp"

#include <cstdint>
#include <vector>

namespace sturz::workflow {

/// Members still to do, the one with the most predicted particle-updates first, where a member
/// takes long enough (a second) for the order to matter; else as they are numbered. A member that
/// cannot be described starts last: it will fail with its reason.
std::vector<std::int64_t> start_order(const EnsembleJob&);

}  // namespace sturz::workflow
