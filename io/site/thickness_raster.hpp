// SPDX-License-Identifier: Apache-2.0
/// A release thickness from any raster, carried onto the terrain's grid without losing volume.
///
/// Every source cell with thickness becomes a quadrilateral in the terrain's system; its volume is
/// shared out to the terrain cells by the exact area of overlap. This holds for shifted, finer,
/// coarser, oblong, rotated and reprojected grids alike.
#pragma once

#include "engine/terrain/raster.hpp"
#include "io/gdal/gdal_raster.hpp"

namespace sturz {

struct ThicknessRead {
  /// On the terrain's cells around the source, vertical [m]; nothing lies beyond.
  Raster<double> thickness;
  double volume_m3 = 0;  ///< of the source raster; the result holds exactly this
  double area_m2 = 0;    ///< of source cells with thickness
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
  InputIdentity identity;  ///< of what was read, before the factor
};

/// Nodata and NaN mean zero. Volume and area are those of the source cells in metres of their own
/// system, or in the terrain's where the file is in degrees; the correction is noted.
///
/// \param request cell_size_m is not used
/// \param terrain grid to fill; without a system of its own the coordinates are taken as they are
/// \throws SetupError naming key and file: as read_elevation; negative thickness (with the cell);
///   no thickness at all; thickness outside the terrain (how much and where)
ThicknessRead read_thickness(const RasterRequest& request, const Grid& terrain);

/// What can be said of it without a terrain. \throws SetupError as read_thickness
void check_thickness(const RasterRequest& request, bool terrain_is_local);

}  // namespace sturz
