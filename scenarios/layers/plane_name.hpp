// SPDX-License-Identifier: Apache-2.0
/// How one plane of a map is called where it is a file of its own.
#pragma once

#include "scenarios/layers/layer_stack.hpp"

#include <string>

namespace sturz {

/// Short, with the value of the axis and the unit, without an ending: "thickness_exceedance_0.5_m",
/// "thickness_exceedance_0.5_m_lower", "speed_p95_m_s", "energy_mean_kj_m2",
/// "probability_of_reach".
std::string plane_name(const Layer& layer, std::size_t plane);

}  // namespace sturz
