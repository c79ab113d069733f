// SPDX-License-Identifier: Apache-2.0
/// What there is to say of the ground before a member is computed.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace sturz {

/// Which part of the raster is read first, and why: one line.
std::string ground_line(const Scenario&, const SceneInputs&);

/// How the warning begins that mass might pass the edge of the terrain.
inline constexpr std::string_view edge_warning = "edge of the terrain: ";

/// Where the energy line meets the end of the known ground.
std::vector<std::string> ground_warnings(const Scenario&, const SceneInputs&);

}  // namespace sturz
