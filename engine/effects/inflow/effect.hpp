// SPDX-License-Identifier: Apache-2.0
/// Columns that enter during a run: an inflow over time, parts of the release that start later.
///
/// A column of an inflow enters at the end of the step in which its time lies, as far on its way as
/// it has come since: a long step leaves no gap. One of a release enters where it lay, at rest or
/// with the release's own velocity; steps are cut so that they end when it starts. What waits is in
/// no set: it exerts nothing, covers nothing, and the run goes on for it (MovingSet::to_come).
#pragma once

#include "engine/effects/inflow/settings.hpp"
#include "engine/effects/step.hpp"

#include <cstddef>

namespace sturz {

void add_inflow(Step&, State&, std::size_t set, InflowSettings);

/// Memory of one column that waits [bytes].
std::size_t waiting_column_bytes();

}  // namespace sturz
