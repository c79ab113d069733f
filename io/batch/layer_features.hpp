// SPDX-License-Identifier: Apache-2.0
/// Which features the polygon layer of a release has.
#pragma once

#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace sturz {

/// Their identifiers (FID) in the order of the file, as release.feature takes them.
/// \throws SetupError when the scene has no release.polygon, or its layer cannot be opened
std::vector<std::string> layer_features(const Scenario&);

}  // namespace sturz
