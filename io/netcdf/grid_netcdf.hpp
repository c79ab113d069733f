// SPDX-License-Identifier: Apache-2.0
/// How a Grid stands in a netCDF file: x and y of the cell centres, and the variable `crs`.
#pragma once

#include "engine/terrain/raster.hpp"
#include "io/netcdf/netcdf_file.hpp"

#include <string>

namespace sturz {

/// Identifiers of the dimensions that write_grid made.
struct GridDimensions {
  int y = -1, x = -1;
};

/// Writes dimensions and coordinates y (north to south), x, and, if the grid has a system, `crs`
/// with CF parameters, crs_wkt, and what GDAL reads (spatial_ref, GeoTransform).
GridDimensions write_grid(NetcdfWriter& file, const Grid& grid);
/// The variable `crs` alone, for files without maps; nothing for a grid without a system.
void write_crs(NetcdfWriter& file, const Grid& grid);
/// Attribute grid_mapping = "crs" where the grid has a system.
void link_grid(NetcdfWriter& file, int variable, const Grid& grid);
/// The grid's exact numbers as attributes of the file: grid_west_m, grid_north_m, ...
void write_grid_attributes(NetcdfWriter& file, const Grid& grid);

/// The grid of a file of maps; files of others without our attributes are read from x and y.
/// \throws IoError when x or y is missing, unequal or not north-up
Grid read_grid(const NetcdfReader& file);
/// The grid that write_grid_attributes wrote, with the system of `crs`. \throws IoError
Grid read_grid_attributes(const NetcdfReader& file);

}  // namespace sturz
