// SPDX-License-Identifier: Apache-2.0
/// Keys that a scene gives and that change nothing in its formulation.
#pragma once

#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace sturz {

/// Paths of the schema whose value differs from the default (or is there at all, for those without
/// one) and is read by nothing in columns, or in full stress. In the order of the schema.
/// \param friction_inside  the release is a pile that `earth_pressure: auto` gives internal
/// friction
std::vector<std::string> idle_keys(const Scenario&, bool depth_averaged,
                                   bool friction_inside = false);

/// Likewise thresholds of layers that no member of the scene has, whatever its formulation.
std::vector<std::string> idle_layer_keys(const Scenario&);

}  // namespace sturz
