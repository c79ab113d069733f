// SPDX-License-Identifier: Apache-2.0
/// Release polygons from any vector layer that OGR reads, laid exactly onto the terrain's cells.
#pragma once

#include "engine/terrain/raster.hpp"
#include "io/site/polygon_request.hpp"
#include "scenarios/input_identity.hpp"
#include "scenarios/scene_inputs.hpp"

#include <string>
#include <vector>

namespace sturz {

struct PolygonRelease {
  Raster<double>
      pattern;  ///< on cells of the terrain around the polygons: share 0..1, or thickness [m]
  Raster<double> cover;  ///< where the pattern is a thickness: share 0..1 of the same cells
  /// Of each start time that the features name, ascending: share of what the pattern has in a cell
  /// that starts then. Empty without release.start_time_attribute.
  std::vector<ReleaseStart> starts;
  bool is_thickness = false;  ///< a thickness attribute was read
  double area_m2 = 0;         ///< exact, of all polygons together
  double volume_m3 = 0;       ///< exact, 0 without a thickness attribute
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
  InputIdentity identity;  ///< of what was read
};

/// Polygons and multi-polygons with holes, any number of features. Overlapping features count once
/// when only shares are wanted. Shares are exact: their sum times the cell area is the area.
///
/// \param terrain grid to fill; without a system of its own the coordinates are taken as they are
/// \throws SetupError naming key and file: missing file, layer or field; empty layer or polygon;
///   points or lines; no coordinate system; (partly) outside the terrain, by how much and where;
///   thickness that is missing or not positive; overlapping features with thicknesses
PolygonRelease read_release_polygons(const PolygonRequest& request, const Grid& terrain);

}  // namespace sturz
