// SPDX-License-Identifier: Apache-2.0
/// A raster exactly as its file has it: values with NaN for nodata, placement, coordinate system.
/// The step before any resampling; elevation and thickness share it. Read whole or window by
/// window. Included by .cpp files only.
#pragma once

#include "engine/terrain/raster.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/gdal/height_unit.hpp"
#include "io/gdal/raster_request.hpp"
#include "scenarios/input_identity.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace sturz {

struct RasterSource {
  std::string label;  ///< "terrain.raster = bed.tif"
  double max_cells = max_raster_cells;
  int n_cols = 0, n_rows = 0;
  int col0 = 0, row0 = 0;      ///< first cell of these in the file, in the file's own order
  std::vector<double> values;  ///< [n_rows][n_cols] metres, NaN = nodata
  /// GDAL geotransform; where not rotated, rows run south and columns east (files are flipped).
  std::array<double, 6> affine{};
  OGRSpatialReference crs;  ///< empty only when allowed by the caller or local by the key
  double quantum_m = 0;     ///< all heights are whole multiples of it; 0: they are not
  std::vector<std::string> notes;
  std::vector<std::string> warnings;  ///< what was guessed, and what cannot be right
  InputIdentity identity;             ///< of what was read

  bool is_axis_aligned() const { return affine[2] == 0 && affine[4] == 0; }
  double x_of(double col, double row) const {
    return affine[0] + col * affine[1] + row * affine[2];
  }
  double y_of(double col, double row) const {
    return affine[3] + col * affine[4] + row * affine[5];
  }
  /// Edge lengths of a cell in map units.
  double col_step() const;
  double row_step() const;
};

/// A `number` has no unit to be converted and no direction.
enum class RasterQuantity { elevation, thickness, number };

/// A raster that is open. What one cell becomes follows from its own number, so any window of the
/// file has the same values.
class OpenRaster {
 public:
  /// \param crs_optional a file without a system is taken as it is (bare scenes)
  /// \throws SetupError; see read_elevation
  OpenRaster(const RasterRequest& request, RasterQuantity quantity, bool crs_optional = false);

  /// The whole file without its values, turned north up.
  const RasterSource& about() const { return about_; }
  Window whole() const { return {0, 0, about_.n_rows, about_.n_cols}; }
  /// Cells of a window, counted north up, with their own placement, notes and, where wanted,
  /// identity. \throws SetupError when it is not complete or holds more than request.max_cells
  RasterSource read(const Window&, bool identified = true);
  /// The hashes that parts of the file have now, by the names that an identity gave them; without
  /// those that are no parts of this file. Reads part by part and holds one. \throws SetupError
  /// when the file is not complete
  std::map<std::string, std::string> hashes_of(const std::vector<std::string>& parts);

 private:
  void turn_north_up();

  OpenDataset dataset_;
  RasterSource about_;
  RasterQuantity quantity_;
  HeightUnit unit_;
  std::string shape_;  ///< for the identity
  bool south_up_ = false, east_to_west_ = false;
};

/// Reads band 1 of the whole file. \param crs_optional a file without a system is taken as it is
/// (bare scenes) \throws SetupError; see read_elevation
RasterSource read_source(const RasterRequest& request, RasterQuantity quantity,
                         bool crs_optional = false);

/// \throws SetupError when `n_cols` x `n_rows` exceeds `most`
void require_raster_size(double n_cols, double n_rows, const std::string& label,
                         double most = max_raster_cells);

}  // namespace sturz
