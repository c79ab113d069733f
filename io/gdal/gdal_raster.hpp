// SPDX-License-Identifier: Apache-2.0
/// Any raster that GDAL reads, as elevation on a north-up grid of square metric cells.
#pragma once

#include "engine/terrain/raster.hpp"
#include "io/gdal/raster_request.hpp"
#include "scenarios/input_identity.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sturz {

/// A raster on its working grid, and what was done to get it there.
struct RasterRead {
  Raster<double> raster;              ///< [m], NaN = nodata
  std::vector<std::string> notes;     ///< one sentence each: reprojected, resampled, turned, ...
  std::vector<std::string> warnings;  ///< what was guessed, and what cannot be right
  InputIdentity identity;             ///< of what was read
};

/// An elevation raster on its working grid, read window by window. A window has the same bits as
/// the same cells of a larger one.
class ElevationRaster {
 public:
  /// \throws SetupError; see read_elevation
  explicit ElevationRaster(const RasterRequest& request);
  ~ElevationRaster();
  ElevationRaster(const ElevationRaster&) = delete;
  ElevationRaster& operator=(const ElevationRaster&) = delete;

  /// The whole working grid.
  const Grid& grid() const;
  /// \pre the window lies on the grid \throws SetupError when it is larger than
  ///   request.max_cells, or the file is not complete
  RasterRead read(const Window&);
  /// The same for a look: elevations alone.
  Raster<double> look(const Window&);
  /// What parts of the file hold now, by the names that an identity gave them; without those that
  /// are no parts of this file. Reads these parts alone. \throws SetupError when the file is not
  /// complete
  std::map<std::string, std::string> hashes_of(const std::vector<std::string>& parts);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Band 1 as elevation [m] (band scale, offset and unit applied).
///
/// Kept cell by cell when the file is a north-up (or south-up: turned) grid of square cells in a
/// metric system. Otherwise bilinear: degrees, feet and maps whose lengths are more than 2 % off
/// the ground's go to the UTM zone of the raster's centre; rotated or oblong cells become squares
/// as wide as the shorter edge. Declared nodata, NaN, masks, the usual undeclared marks (-9999,
/// -3.4e38, ...) and what lies above 9000 or below -11000 m become NaN and never an elevation.
///
/// \throws SetupError naming key and file: missing or unreadable file; no coordinate system; metres
///   tagged as degrees; more than 400 million cells; no valid cell
RasterRead read_elevation(const RasterRequest& request);

}  // namespace sturz
