// SPDX-License-Identifier: Apache-2.0
/// The one-line bar of a running ensemble or member.
#pragma once

#include "engine/simulation/simulation.hpp"
#include "ensemble/members/runner.hpp"

#include <cstdint>
#include <string>

namespace sturz::app {

/// "[####....] 12/64 members, 1 failed | 340/h | 9 min 10 s left", cut to `columns`; under a stop
/// rule "... 70/~96 members | 340/h | 5 min left | half width 0.112, wanted 0.1": so many members
/// and that time it will probably take.
/// \param finished_before members of an earlier call; they count in the bar, not in the pace
std::string ensemble_bar(const RunnerProgress&, std::int64_t finished_before, int columns);

/// "[####....] t 12.5 of 60 s | front 310 m | 23.1 m/s | 85 steps/s | 40 s left".
std::string member_bar(const Progress&, int columns);

}  // namespace sturz::app
