// SPDX-License-Identifier: Apache-2.0
/// Which levels a multilevel ensemble uses, how many members each gets, and when there are enough.
#pragma once

#include "ensemble/workflow/multilevel/estimates.hpp"
#include "ensemble/workflow/multilevel/plan_file.hpp"

#include <optional>
#include <span>

namespace sturz::workflow {

/// So many decisions at most, and none for what an error is above the wanted one by less.
inline constexpr std::size_t most_rounds = 5;
inline constexpr double near_enough = 1.05;

/// What the members so far say is to be computed next: nothing where what was asked for is reached,
/// or where no more of them would help. The levels are those of the first round.
/// \param rounds those before \param cost_s [parts] CPU seconds of a member
/// \pre least_draws valid members of the dearest level \throws Cancelled; SetupError for more
/// than a million members
std::optional<PlanRound> next_round(const LevelMembers&, std::span<const PlanRound> rounds,
                                    const TargetSpec&, std::span<const double> cost_s, CancelFlag);

}  // namespace sturz::workflow
