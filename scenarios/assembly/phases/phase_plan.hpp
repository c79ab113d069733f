// SPDX-License-Identifier: Apache-2.0
/// Grains and liquid as two sets of columns: their numbers, their release, and the words for them.
#pragma once

#include "engine/effects/phases/effect.hpp"
#include "engine/effects/state.hpp"
#include "engine/particles/release.hpp"
#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace sturz {

/// \param columns  of the mixture as a whole: spacing, zones, instruction set \param bed  by zone;
/// friction and cohesion are the grains', the turbulent coefficient and the mixture's viscosity the
/// liquid's
TwoPhaseSettings plan_phases(const Scenario& numbers, const DepthAveragedSettings& columns,
                             const std::vector<BasalResistance>& bed);

/// Makes a second set of the liquid in what set 0 holds as a whole, both where the mixture lies.
void split_phases(State&, const TwoPhaseSettings&, double solid_fraction);

/// Thickness of grains or of liquid in a column of the mixture [m]. \param share  of the volume
std::vector<double> thickness_of(const Release&, double share);

/// What is said of the drag: law, time in which a slip dies out, largest slip where it is computed.
std::string drag_text(const Scenario& numbers, const TwoPhaseSettings&, double thickness_m);

}  // namespace sturz
