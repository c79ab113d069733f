// SPDX-License-Identifier: Apache-2.0
/// Any raster that GDAL reads, as elevation on a north-up grid of square metric cells.
#pragma once

#include "engine/terrain/raster.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sturz {

/// More cells than this are refused before anything is allocated.
inline constexpr double max_raster_cells = 400e6;

/// Which file to read, and what the scenario says about it.
struct RasterRequest {
  std::string path;                    ///< as written; relative paths start at `directory`
  std::string key = "terrain.raster";  ///< scenario key, for messages
  std::string directory;               ///< of the scenario file
  std::string crs;                     ///< replaces the file's own system; empty: not given
  std::string crs_key = "terrain.crs";
  std::string fallback_crs;  ///< stands in only when the file has none; empty: refuse
  std::string fallback_crs_key;
  double factor = 1;                  ///< multiplies the values of a thickness raster
  std::optional<double> cell_size_m;  ///< wanted cells; default: the raster's own
  double max_cells = max_raster_cells;
};

/// A raster on its working grid, and what was done to get it there.
struct RasterRead {
  Raster<double> raster;           ///< [m], NaN = nodata
  std::vector<std::string> notes;  ///< one sentence each: reprojected, resampled, turned, ...
  std::vector<std::string> files;  ///< the file and its companions, for checksums
};

/// Band 1 as elevation [m] (band scale, offset and unit applied).
///
/// Kept cell by cell when the file is a north-up (or south-up: turned) grid of square cells in a
/// metric system. Otherwise bilinear: degrees, feet and maps whose lengths are more than 2 % off
/// the ground's go to the UTM zone of the raster's centre; rotated or oblong cells become squares
/// as wide as the shorter edge. Declared nodata, NaN, masks and the usual undeclared marks
/// (-9999, -3.4e38, ...) become NaN and never an elevation.
///
/// \throws SetupError naming key and file: missing or unreadable file; no coordinate system; metres
///   tagged as degrees; more than 400 million cells; no valid cell
RasterRead read_elevation(const RasterRequest& request);

}  // namespace sturz
