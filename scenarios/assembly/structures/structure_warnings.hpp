// SPDX-License-Identifier: Apache-2.0
/// What a reader has to know of dams and buildings on ground that is too coarse for them.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <string>
#include <vector>

namespace sturz {

/// \param cell_m of the ground that the member feels \param columns it feels that of columns
std::vector<std::string> structure_warnings(const Scenario& numbers, const SceneInputs&,
                                            double cell_m, bool columns);

}  // namespace sturz
