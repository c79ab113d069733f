// SPDX-License-Identifier: Apache-2.0
/// The files of `observation`, one by one: polygons, a line, a point, a raster of thicknesses, laid
/// on the cells of the maps. Included by .cpp files only.
#pragma once

#include "io/gdal/raster_request.hpp"
#include "io/site/polygon_request.hpp"
#include "scenarios/choices.hpp"
#include "scenarios/input_identity.hpp"
#include "scenarios/observation/observed_event.hpp"

#include <string>
#include <vector>

namespace sturz {

/// What is said of a file that was read.
struct FileRead {
  std::vector<std::string> notes, warnings;
  InputIdentity identity;
};

struct AreaRead : FileRead {
  ObservedArea area;                     ///< without its sd; as far as it lies on the maps
  std::vector<std::vector<Vec2>> rings;  ///< outer ones and holes, whole, to be drawn
};

/// \param maps their whole grid; no cells: only the file is checked
/// \throws SetupError naming key and file: as read_features(); polygons wholly beyond the maps
AreaRead read_observed_area(const PolygonRequest&, const Grid& maps);

struct CornersRead : FileRead {
  std::vector<Vec2> corners;
};

/// The corners of the one line of a layer, in the maps' system.
/// \throws SetupError naming key and file: no or several features, another shape, all in one place
CornersRead read_observed_line(const PolygonRequest&, const Grid& maps);
/// The one point of a layer.
CornersRead read_observed_point(const PolygonRequest&, const Grid& maps);

struct ThicknessValuesRead : FileRead {
  Raster<double> value;  ///< on cells of the maps around the file [m], NaN where less than half of
                         ///< a cell was measured
};

/// Mean of what the file holds in each cell of the maps, from up to 16 x 16 places of it.
/// \throws SetupError naming key and file: as read_source(); a thickness below zero; nothing
///   measured on the maps
ThicknessValuesRead read_observed_thickness(const RasterRequest&, ThicknessSign, const Grid& maps);

}  // namespace sturz
