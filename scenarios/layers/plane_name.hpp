// SPDX-License-Identifier: Apache-2.0
/// How one plane of a map is called: as a key, and where it is a file or a layer of its own.
#pragma once

#include "scenarios/layers/layer_stack.hpp"

#include <string>

namespace sturz {

/// Short, with the value of the axis and the unit, without an ending: "thickness_exceedance_0.5_m",
/// "thickness_exceedance_0.5_m_lower", "speed_p95_m_s", "energy_mean_kj_m2",
/// "probability_of_reach".
std::string plane_name(const Layer& layer, std::size_t plane);

/// The same for people who look through a folder, with P for a probability and units as they are
/// written: "P_thickness_gt_0.5m", "P_thickness_gt_0.5m_lower", "P_reached", "speed_p95_m_s",
/// "energy_mean_kJ_m2".
std::string plane_file_name(const Layer& layer, std::size_t plane);

}  // namespace sturz
