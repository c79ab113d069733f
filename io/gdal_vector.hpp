// SPDX-License-Identifier: Apache-2.0
/// Release polygons from any vector layer that OGR reads, laid exactly onto the terrain's cells.
#pragma once

#include "engine/terrain/raster.hpp"

#include <string>
#include <vector>

namespace sturz {

/// Which polygons to read, and what the scenario says about them.
struct PolygonRequest {
  std::string path;                     ///< as written; relative paths start at `directory`
  std::string layer;                    ///< empty: the first
  std::string thickness_attribute;      ///< numeric field [m]; empty: shares only
  std::string key = "release.polygon";  ///< scenario key, for messages
  std::string directory;
  std::string crs;  ///< replaces the layer's own system; empty: not given
  std::string crs_key = "release.crs";
};

struct PolygonRelease {
  Raster<double> pattern;     ///< on the terrain's grid: share 0..1, or thickness [m]
  bool is_thickness = false;  ///< a thickness attribute was read
  double area_m2 = 0;         ///< exact, of all polygons together
  double volume_m3 = 0;       ///< exact, 0 without a thickness attribute
  std::vector<std::string> notes;
  std::vector<std::string> files;  ///< the file and its companions, for checksums
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
