// SPDX-License-Identifier: Apache-2.0
/// What a scene says of its bed in files: zones with numbers of their own, and what can be taken.
#pragma once

#include "engine/terrain/raster.hpp"
#include "io/site/polygon_request.hpp"
#include "scenarios/input_identity.hpp"
#include "scenarios/scenario.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace sturz {

/// The polygons of basal.zones[i].
PolygonRequest zone_request(const Scenario&, std::size_t i);

struct BedSupplyInput {
  /// On the terrain's cells around it, nothing lies beyond: 1 inside erosion.polygon, or the depth
  /// of erosion.depth_raster [m].
  Raster<double> pattern;
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
  InputIdentity identity;  ///< of what was read
};

/// Whether `erosion` names a file.
bool has_bed_supply_file(const Scenario&);
/// \param held part of the terrain that is read: of a polygon only the cells there are listed
/// \throws SetupError naming key and file, as read_zone_cells and read_thickness
BedSupplyInput read_bed_supply(const Scenario&, const Grid& terrain, const Window& held);
/// What can be said of it without a terrain.
void check_bed_supply(const Scenario&);

}  // namespace sturz
