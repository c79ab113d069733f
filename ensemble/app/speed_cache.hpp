// SPDX-License-Identifier: Apache-2.0
/// Where this user's programs remember the speed of the machine.
#pragma once

#include "ensemble/workflow/machine/machine_speed.hpp"

namespace sturz::app {

/// $XDG_CACHE_HOME/sturz/speed.json, or the same under ~/.cache; nowhere when neither is known.
workflow::SpeedCache speed_cache(bool measure_again = false);

}  // namespace sturz::app
