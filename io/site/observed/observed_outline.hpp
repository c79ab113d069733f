// SPDX-License-Identifier: Apache-2.0
/// What a mapped event covered, to be drawn over maps. Computes nothing.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"
#include "scenarios/input_identity.hpp"
#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace sturz {

struct ObservedOutline {
  std::vector<std::vector<Vec2>>
      rings;  ///< in the terrain's system [m]; the last point is the first
  std::vector<std::string> notes, warnings;
  InputIdentity identity;
};

/// The polygons of hazard.observed_polygon, outer rings and holes alike.
/// \param terrain its whole grid; no cells: the terrain could not be read, only the file is checked
/// \throws SetupError naming key and file: as read_features(); an outline beyond the terrain
ObservedOutline read_observed_outline(const Scenario&, const Grid& terrain);

}  // namespace sturz
