// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf/grid_netcdf.hpp"

#include "io/files/io_error.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/gdal/gdal_raster.hpp"
#include "io/netcdf/cf_grid_mapping.hpp"

#include <cpl_conv.h>
#include <fmt/core.h>

#include <cmath>

namespace sturz {
namespace {

/// Coordinates that lie nowhere on the map carry no name of a projection.
void write_axis(NetcdfWriter& file, const char* name, bool projected, int dimension,
                const std::vector<double>& values) {
  const int variable = file.variable(name, NcType::float64, {dimension});
  const bool east = name[0] == 'x';
  if (projected)
    file.text(variable, "standard_name", fmt::format("projection_{}_coordinate", name));
  file.text(variable, "long_name",
            fmt::format("{} of the cell centre", projected ? (east ? "easting" : "northing")
                                                 : east    ? "local x"
                                                           : "local y"));
  file.text(variable, "units", "m");
  file.text(variable, "axis", east ? "X" : "Y");
  file.put(variable, values);
}

std::string wkt1(const OGRSpatialReference& crs) {
  const GdalScope scope;
  char* text = nullptr;
  // Some systems cannot be said in the old language; readers then use crs_wkt.
  std::string wkt = crs.exportToWkt(&text) == OGRERR_NONE && text != nullptr ? text : "";
  CPLFree(text);
  return wkt;
}

/// Spacing of an axis. \throws IoError unless equal and of the given direction
double axis_step(const NetcdfReader& file, const char* name, const std::vector<double>& values,
                 double direction) {
  if (values.size() < 2)
    throw IoError(fmt::format("{}: axis {} has fewer than two cells. Is it a map?",
                              file.file().string(), name));
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(step * direction > 0) ||
        std::abs(values[i] - values[i - 1] - step) > 1e-6 * std::abs(step))
      throw IoError(fmt::format("{}: axis {} is not evenly spaced {}. Resample the file.",
                                file.file().string(), name,
                                direction > 0 ? "from west to east" : "from north to south"));
  return std::abs(step);
}

std::string crs_text(const NetcdfReader& file) {
  return file.has("crs") ? file.text("crs", "crs_wkt").value_or("") : "";
}

}  // namespace

void write_crs(NetcdfWriter& file, const Grid& grid) {
  if (grid.crs_wkt.empty()) return;
  const OGRSpatialReference crs = crs_from_wkt(grid.crs_wkt);
  const int variable = file.variable("crs", NcType::int32, {});
  const GridMapping mapping = cf_grid_mapping(crs);
  for (const auto& [name, value] : mapping.texts) file.text(variable, name, value);
  for (const auto& [name, values] : mapping.numbers) file.numbers(variable, name, values);
  if (const std::string wkt = wkt1(crs); !wkt.empty()) file.text(variable, "spatial_ref", wkt);
  file.text(variable, "GeoTransform",
            fmt::format("{:.17g} {:.17g} 0 {:.17g} 0 {:.17g}", grid.west_m, grid.cell_m,
                        grid.north_m, -grid.cell_m));
  const std::int32_t nothing = 0;
  file.put(variable, std::span(&nothing, 1));
}

GridDimensions write_grid(NetcdfWriter& file, const Grid& grid) {
  const GridDimensions dimensions{file.dimension("y", static_cast<std::size_t>(grid.n_rows)),
                                  file.dimension("x", static_cast<std::size_t>(grid.n_cols))};
  std::vector<double> x, y;
  for (int col = 0; col < grid.n_cols; ++col) x.push_back(grid.x_center(col));
  for (int row = 0; row < grid.n_rows; ++row) y.push_back(grid.y_center(row));
  const bool projected = !grid.crs_wkt.empty();
  write_axis(file, "y", projected, dimensions.y, y);
  write_axis(file, "x", projected, dimensions.x, x);
  write_crs(file, grid);
  return dimensions;
}

void link_grid(NetcdfWriter& file, int variable, const Grid& grid) {
  if (!grid.crs_wkt.empty()) file.text(variable, "grid_mapping", "crs");
}

void write_grid_attributes(NetcdfWriter& file, const Grid& grid) {
  file.number(NetcdfWriter::global, "grid_west_m", grid.west_m);
  file.number(NetcdfWriter::global, "grid_north_m", grid.north_m);
  file.number(NetcdfWriter::global, "grid_cell_m", grid.cell_m);
  file.integer(NetcdfWriter::global, "grid_n_cols", grid.n_cols);
  file.integer(NetcdfWriter::global, "grid_n_rows", grid.n_rows);
}

Grid read_grid_attributes(const NetcdfReader& file) {
  const auto need = [&](const char* name) {
    const auto value = file.number("", name);
    if (!value)
      throw IoError(
          fmt::format("{}: has no attribute {} (not a file of this program, or damaged). "
                      "Compute it again.",
                      file.file().string(), name));
    return *value;
  };
  Grid grid;
  grid.west_m = need("grid_west_m");
  grid.north_m = need("grid_north_m");
  grid.cell_m = need("grid_cell_m");
  const double n_cols = need("grid_n_cols"), n_rows = need("grid_n_rows");
  const bool sound = std::abs(grid.west_m) <= farthest_coordinate &&
                     std::abs(grid.north_m) <= farthest_coordinate && grid.cell_m > 0 &&
                     grid.cell_m <= farthest_coordinate && n_cols >= 0 && n_rows >= 0 &&
                     n_cols * n_rows <= max_raster_cells && n_cols <= max_raster_cells &&
                     n_rows <= max_raster_cells;
  if (!sound)
    throw IoError(
        fmt::format("{}: its grid of {:g} x {:g} cells of {:g} m is none (the file is "
                    "damaged). Compute it again.",
                    file.file().string(), n_cols, n_rows, grid.cell_m));
  grid.n_cols = static_cast<int>(n_cols);
  grid.n_rows = static_cast<int>(n_rows);
  grid.crs_wkt = crs_text(file);
  return grid;
}

Grid read_grid(const NetcdfReader& file) {
  if (file.number("", "grid_cell_m")) return read_grid_attributes(file);
  const std::vector<double> x = file.doubles("x"), y = file.doubles("y");
  const double step_x = axis_step(file, "x", x, 1), step_y = axis_step(file, "y", y, -1);
  if (std::abs(step_x - step_y) > 1e-6 * step_x)
    throw IoError(fmt::format("{}: cells of {:g} x {:g} m are not square. Resample the file.",
                              file.file().string(), step_x, step_y));
  return {static_cast<int>(x.size()),
          static_cast<int>(y.size()),
          x.front() - step_x / 2,
          y.front() + step_x / 2,
          step_x,
          crs_text(file)};
}

}  // namespace sturz
