// SPDX-License-Identifier: Apache-2.0
/// Results of the same members at several fidelities, lined up.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/simulation/member_parts.hpp"
#include "ensemble/fidelity/multilevel_gain.hpp"

#include <span>
#include <string>
#include <vector>

namespace sturz {

/// One LevelValues per result that at least eight members let one know at every level, and one
/// called `map` of whether their peak thickness exceeds the threshold, in cells that between 5 and
/// 95 % of the members of the first level cover. Of many cells every k-th is taken, so that they
/// fit into some 200 MB. \param levels the dearest first; all on one grid \throws Cancelled
std::vector<LevelValues> level_values(std::span<const MemberParts* const> levels,
                                      std::span<const std::string> results, double threshold_m,
                                      CancelFlag cancel = {});

}  // namespace sturz
