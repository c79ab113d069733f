// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/gdal_raster.hpp"

#include "engine/core/error.hpp"
#include "io/doubts/dem_doubts.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/gdal/raster_source.hpp"

#include <cpl_string.h>
#include <fmt/core.h>
#include <gdal_alg.h>
#include <gdal_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

namespace sturz {
namespace {

/// Cells count as square, and a wanted size as the file's own, when the outline moves less than
/// this share of a cell.
constexpr double placement_tolerance = 0.01;

bool same_edge(double a, double b, int n_cells) {
  return std::abs(a - b) * n_cells < placement_tolerance * std::min(a, b);
}

bool has_square_cells(const RasterSource& s) {
  return s.is_axis_aligned() && same_edge(s.affine[1], -s.affine[5], std::max(s.n_cols, s.n_rows));
}

Raster<double> taken_as_it_is(RasterSource& source) {
  Raster<double> raster;
  raster.grid = {source.n_cols,    source.n_rows,    source.affine[0],
                 source.affine[3], source.affine[1], crs_wkt2(source.crs)};
  raster.values = std::move(source.values);
  return raster;
}

struct Extent {
  double west, south, east, north;
};

Grid grid_over(const Extent& e, double cell, const OGRSpatialReference& crs,
               const RasterSource& source) {
  const std::string& label = source.label;
  const double n_cols = std::floor((e.east - e.west) / cell + placement_tolerance);
  const double n_rows = std::floor((e.north - e.south) / cell + placement_tolerance);
  require(n_cols >= 1 && n_rows >= 1,
          fmt::format("{}: cells of {:g} m are larger than the raster ({:g} x {:g} m). Use "
                      "smaller cells.",
                      label, cell, e.east - e.west, e.north - e.south));
  require_raster_size(n_cols, n_rows, label, source.max_cells);
  return {static_cast<int>(n_cols), static_cast<int>(n_rows), e.west, e.north, cell, crs_wkt2(crs)};
}

/// Extent in the file's own system: of the raster's corners.
Extent own_extent(const RasterSource& s) {
  Extent e{INFINITY, INFINITY, -INFINITY, -INFINITY};
  for (const int col : {0, s.n_cols})
    for (const int row : {0, s.n_rows}) {
      e.west = std::min(e.west, s.x_of(col, row));
      e.east = std::max(e.east, s.x_of(col, row));
      e.south = std::min(e.south, s.y_of(col, row));
      e.north = std::max(e.north, s.y_of(col, row));
    }
  return e;
}

void warp_bilinear(RasterSource& source, const OGRSpatialReference& to, Raster<double>& target) {
  const DatasetPtr from = wrap_in_memory(source.values.data(), GDT_Float64, source.n_cols,
                                         source.n_rows, source.affine.data());
  const DatasetPtr into = wrap_in_memory(target.values.data(), GDT_Float64, target.grid.n_cols,
                                         target.grid.n_rows, affine_of(target.grid).data());
  from->GetRasterBand(1)->SetNoDataValue(nan_d);
  into->GetRasterBand(1)->SetNoDataValue(nan_d);
  from->SetSpatialRef(&source.crs);
  into->SetSpatialRef(&to);
  CPLStringList options;
  // A hundredth of a cell is the largest error of the fast approximate transformer; one thread,
  // because members may be running beside this.
  for (const char* word :
       {"-r", "bilinear", "-et", "0.01", "-wo", "NUM_THREADS=1", "-wo", "INIT_DEST=nan"})
    options.AddString(word);
  const std::unique_ptr<GDALWarpAppOptions, decltype(&GDALWarpAppOptionsFree)> settings(
      GDALWarpAppOptionsNew(options.List(), nullptr), &GDALWarpAppOptionsFree);
  GDALDatasetH sources[] = {from.get()};
  int usage_error = 0;
  CPLErrorReset();
  if (GDALWarp(nullptr, into.get(), 1, sources, settings.get(), &usage_error) == nullptr)
    throw SetupError(fmt::format("{}: cannot be resampled ({}). Prepare it with gdalwarp.",
                                 source.label, gdal_reason()));
  into->FlushCache();
}

Raster<double> resampled_in_place(RasterSource& source, double cell) {
  Raster<double> raster(grid_over(own_extent(source), cell, source.crs, source), nan_d);
  const bool square = has_square_cells(source);
  const std::string why =
      !source.is_axis_aligned()
          ? "rotated cells"
          : (square ? fmt::format("{:g} m cells", source.affine[1])
                    : fmt::format("{:g} x {:g} m cells", source.affine[1], -source.affine[5]));
  warp_bilinear(source, source.crs, raster);
  source.notes.push_back(
      fmt::format("{}: resampled bilinearly from {} to {:g} m squares", source.label, why, cell));
  return raster;
}

/// Edge of the smaller side of the central cell in the target system, to three digits.
double natural_cell(const RasterSource& s, OGRCoordinateTransformation& transform) {
  const double col = s.n_cols / 2.0, row = s.n_rows / 2.0;
  std::array<double, 3> x{s.x_of(col, row), s.x_of(col + 1, row), s.x_of(col, row + 1)};
  std::array<double, 3> y{s.y_of(col, row), s.y_of(col + 1, row), s.y_of(col, row + 1)};
  if (!transform.Transform(3, x.data(), y.data())) return 0;
  const double edge =
      std::min(std::hypot(x[1] - x[0], y[1] - y[0]), std::hypot(x[2] - x[0], y[2] - y[0]));
  const double digit = std::pow(10.0, std::floor(std::log10(edge)) - 2);
  return std::round(edge / digit) * digit;
}

/// The raster's outline in the target system, widened to whole multiples of the cell.
Extent outline(const RasterSource& s, OGRCoordinateTransformation& transform, double cell) {
  Extent e{INFINITY, INFINITY, -INFINITY, -INFINITY};
  constexpr int pieces = 64;
  for (int i = 0; i <= pieces; ++i)
    for (int side = 0; side < 4; ++side) {
      const double along = static_cast<double>(i) / pieces;
      const double col = s.n_cols * (side < 2 ? along : side - 2);
      const double row = s.n_rows * (side < 2 ? side : along);
      double x = s.x_of(col, row), y = s.y_of(col, row);
      require(transform.Transform(1, &x, &y) != 0,
              s.label + ": part of it cannot be placed in the working system. Cut it out first.");
      e = {std::min(e.west, x), std::min(e.south, y), std::max(e.east, x), std::max(e.north, y)};
    }
  return {std::floor(e.west / cell) * cell, std::floor(e.south / cell) * cell,
          std::ceil(e.east / cell) * cell, std::ceil(e.north / cell) * cell};
}

/// A metric system around the raster's centre: of WGS 84, or on its own datum where the shift
/// between the two is not known.
OGRSpatialReference working_crs_for(RasterSource& s) {
  OGRSpatialReference degrees = parse_crs("EPSG:4326", "working coordinate system");
  // Only the zone is sought here: a shift of some 100 m does not matter.
  const TransformPtr to_degrees(OGRCreateCoordinateTransformation(&s.crs, &degrees));
  double x = s.x_of(s.n_cols / 2.0, s.n_rows / 2.0), y = s.y_of(s.n_cols / 2.0, s.n_rows / 2.0);
  require(to_degrees && to_degrees->Transform(1, &x, &y) != 0,
          fmt::format("{}: its centre ({:.10g}, {:.10g}) cannot be found on the globe by {}. Is "
                      "that the right system?",
                      s.label, x, y, crs_name(s.crs)));
  require(std::isfinite(x) && std::isfinite(y),
          s.label + ": its centre is no place on the globe. Georeference it again.");
  OGRSpatialReference utm = best_metric_crs(x, y);
  if (is_shift_known(s.crs, utm) || !names_a_datum(s.crs)) return utm;
  s.notes.push_back(
      fmt::format("{}: the shift from its datum to WGS 84 is not known; the work is "
                  "done on its own datum",
                  s.label));
  return utm_on_own_datum(s.crs, x, y);
}

Raster<double> reprojected(RasterSource& source, const std::optional<double>& wanted,
                           const std::string& reason) {
  const OGRSpatialReference to = working_crs_for(source);
  std::string warning;
  const TransformPtr transform = transform_between(source.crs, to, source.label, &warning);
  if (!warning.empty()) source.warnings.push_back(warning);
  require(transform != nullptr,
          fmt::format("{}: lies in {}, but {} (cells of {:g} x {:g}; a broken geotransform). "
                      "Georeference it again.",
                      source.label, crs_name(to), reason, source.col_step(), source.row_step()));
  const double cell = wanted ? *wanted : natural_cell(source, *transform);
  require(cell > 0, source.label + ": its cells have no size in the working system. Reproject it.");
  Raster<double> raster(grid_over(outline(source, *transform, cell), cell, to, source), nan_d);
  warp_bilinear(source, to, raster);
  source.notes.push_back(
      fmt::format("{}: reprojected from {} to {} because {}; {:g} m cells, bilinear", source.label,
                  crs_name(source.crs), crs_name(to), reason, cell));
  return raster;
}

Raster<double> on_working_grid(RasterSource& source, const std::optional<double>& wanted) {
  const double col_step = source.col_step(), row_step = source.row_step();
  std::string reason;
  if (!source.crs.IsEmpty() &&  // local coordinates are metres already
      !is_working_crs(source.crs, source.x_of(source.n_cols / 2.0, source.n_rows / 2.0),
                      source.y_of(source.n_cols / 2.0, source.n_rows / 2.0),
                      std::max(col_step, row_step), reason))
    return reprojected(source, wanted, reason);
  const bool own_size = !wanted || same_edge(*wanted, col_step, source.n_cols);
  if (has_square_cells(source) && own_size) return taken_as_it_is(source);
  return resampled_in_place(source, wanted ? *wanted : std::min(col_step, row_step));
}

}  // namespace

RasterRead read_elevation(const RasterRequest& request) {
  const GdalScope scope;
  require(!request.cell_size_m || *request.cell_size_m > 0,
          fmt::format("terrain.cell_size_m = {:g} (must be positive). Give metres.",
                      request.cell_size_m.value_or(0)));
  RasterSource source = read_source(request, RasterQuantity::elevation);
  std::vector<std::string> doubts = dem_doubts(source);
  std::move(doubts.begin(), doubts.end(), std::back_inserter(source.warnings));
  RasterRead result{on_working_grid(source, request.cell_size_m), std::move(source.notes),
                    std::move(source.warnings), std::move(source.identity)};
  const auto& values = result.raster.values;
  require(
      std::any_of(values.begin(), values.end(), [](double v) { return !std::isnan(v); }),
      source.label + ": holds no valid cell (all of it is nodata). Check band and nodata value.");
  return result;
}

}  // namespace sturz
