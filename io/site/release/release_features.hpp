// SPDX-License-Identifier: Apache-2.0
/// The features of a release's polygon layer, for a region that computes each.
#pragma once

#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace sturz {

/// Names of all features of release.polygon, in file order: values of release.feature_key, or FIDs.
/// Geometries are not looked at.
/// \throws SetupError naming key and file: missing file, layer or field; features without a name or
///   two of one name; no feature at all
std::vector<std::string> release_features(const Scenario& scenario);

}  // namespace sturz
