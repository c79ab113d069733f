// SPDX-License-Identifier: Apache-2.0
/// What the program's exit code tells a scheduler.
#pragma once

namespace sturz::app {

enum ExitCode : int {
  ok = 0,
  usage_or_scenario_error = 1,
  too_many_failed = 2,  ///< more than ensemble.max_failed_fraction; maps are written all the same
  interrupted = 3,      ///< the same command goes on where it stopped
};

}  // namespace sturz::app
