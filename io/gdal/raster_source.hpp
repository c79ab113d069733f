// SPDX-License-Identifier: Apache-2.0
/// A raster exactly as its file has it: values with NaN for nodata, placement, coordinate system.
/// The step before any resampling; elevation and thickness share it. Included by .cpp files only.
#pragma once

#include "io/gdal/crs.hpp"
#include "io/gdal/raster_request.hpp"
#include "scenarios/input_identity.hpp"

#include <array>
#include <string>
#include <vector>

namespace sturz {

struct RasterSource {
  std::string label;  ///< "terrain.raster = bed.tif"
  double max_cells = max_raster_cells;
  int n_cols = 0, n_rows = 0;
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

enum class RasterQuantity { elevation, thickness };

/// Reads band 1. \param crs_optional a file without a system is taken as it is (bare scenes)
/// \throws SetupError; see read_elevation
RasterSource read_source(const RasterRequest& request, RasterQuantity quantity,
                         bool crs_optional = false);

/// \throws SetupError when `n_cols` x `n_rows` exceeds `most`
void require_raster_size(double n_cols, double n_rows, const std::string& label,
                         double most = max_raster_cells);

}  // namespace sturz
