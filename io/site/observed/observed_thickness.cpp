// SPDX-License-Identifier: Apache-2.0
#include "engine/core/error.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/raster_source.hpp"
#include "io/site/observed/observed_files.hpp"
#include "io/site/polygon_cover.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

constexpr int most_places = 16;  ///< across a cell of the maps

/// Finds the source's cell at a place of the maps.
class SourceCells {
 public:
  SourceCells(const RasterSource& source, OGRCoordinateTransformation* from_maps)
      : source_(source), from_maps_(from_maps) {
    const auto& a = source.affine;
    const double determinant = a[1] * a[5] - a[2] * a[4];
    inverse_ = {a[5] / determinant, -a[2] / determinant, -a[4] / determinant, a[1] / determinant};
  }
  /// NaN where nothing was measured.
  double at(double x, double y) const {
    if (from_maps_ != nullptr && !from_maps_->Transform(1, &x, &y)) return nan_d;
    const double dx = x - source_.affine[0], dy = y - source_.affine[3];
    const double col = std::floor(inverse_[0] * dx + inverse_[1] * dy);
    const double row = std::floor(inverse_[2] * dx + inverse_[3] * dy);
    if (!(col >= 0 && col < source_.n_cols && row >= 0 && row < source_.n_rows)) return nan_d;
    return source_
        .values[static_cast<std::size_t>(row) * source_.n_cols + static_cast<std::size_t>(col)];
  }

 private:
  const RasterSource& source_;
  OGRCoordinateTransformation* from_maps_;
  std::array<double, 4> inverse_{};
};

/// Cells of the maps under the corners and edges of the source.
Window window_under(const RasterSource& s, OGRCoordinateTransformation* to_maps, const Grid& maps) {
  double west = INFINITY, east = -INFINITY, south = INFINITY, north = -INFINITY;
  constexpr int n = 16;  // an edge is curved a little on its way into another system
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      if (i % n != 0 && j % n != 0) continue;
      double x = s.x_of(double(s.n_cols) * i / n, double(s.n_rows) * j / n);
      double y = s.y_of(double(s.n_cols) * i / n, double(s.n_rows) * j / n);
      if (to_maps != nullptr && !to_maps->Transform(1, &x, &y)) continue;
      west = std::min(west, x), east = std::max(east, x);
      south = std::min(south, y), north = std::max(north, y);
    }
  return west <= east ? cells_under(west, east, south, north, maps) : Window{};
}

/// Mean of the measured places of one cell; NaN when they are fewer than half.
double mean_in_cell(const SourceCells& cells, const Grid& maps, int row, int col, int n) {
  double sum = 0;
  int measured = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double v = cells.at(maps.west_m + (col + (j + 0.5) / n) * maps.cell_m,
                                maps.north_m - (row + (i + 0.5) / n) * maps.cell_m);
      if (std::isfinite(v)) sum += v, ++measured;
    }
  return 2 * measured >= n * n ? sum / measured : nan_d;
}

void refuse_negative(const RasterSource& source) {
  const auto below =
      std::find_if(source.values.begin(), source.values.end(), [](double v) { return v < 0; });
  if (below == source.values.end()) return;
  throw SetupError(fmt::format(
      "{}: holds {:g} (a thickness cannot be below zero). If it is an elevation difference, say "
      "with "
      "observation.thickness_sign which way it counts: rise_positive (after - before) or "
      "fall_positive (before - after).",
      source.label, *below));
}

/// Places across a cell of the maps, at least as dense as the cells of the source: two for each.
int places_across(const RasterSource& source, OGRCoordinateTransformation* from_maps,
                  const Grid& cells) {
  double x = cells.x_center(cells.n_cols / 2), y = cells.y_center(cells.n_rows / 2);
  double across = cells.cell_m, down = cells.cell_m;
  if (from_maps != nullptr) {
    double east = x + cells.cell_m, east_y = y, south = x, south_y = y - cells.cell_m;
    if (from_maps->Transform(1, &x, &y) == 0 || from_maps->Transform(1, &east, &east_y) == 0 ||
        from_maps->Transform(1, &south, &south_y) == 0)
      return most_places;
    across = std::hypot(east - x, east_y - y), down = std::hypot(south - x, south_y - y);
  }
  const double finer = 2 * std::max(across, down) / std::min(source.col_step(), source.row_step());
  return static_cast<int>(std::clamp(std::ceil(finer), 2.0, static_cast<double>(most_places)));
}

}  // namespace

ThicknessValuesRead read_observed_thickness(const RasterRequest& request, ThicknessSign sign,
                                            const Grid& maps) {
  RasterSource source =
      read_source(request, RasterQuantity::thickness, maps.n_cols > 0 && maps.crs_wkt.empty());
  if (sign == ThicknessSign::thickness) refuse_negative(source);
  if (sign == ThicknessSign::fall_positive)
    for (double& v : source.values) v = -v;
  ThicknessValuesRead read;
  if (maps.n_cols > 0) {
    const OGRSpatialReference to = crs_from_wkt(maps.crs_wkt);
    std::string warning;
    const TransformPtr to_maps = transform_between(source.crs, to, source.label, &warning);
    const TransformPtr from_maps = transform_between(to, source.crs, source.label, &warning);
    if (!warning.empty()) source.warnings.push_back(warning);
    if (to_maps)
      source.notes.push_back(fmt::format("{}: reprojected from {} to {}", source.label,
                                         crs_name(source.crs), crs_name(to)));
    const Window window = window_under(source, to_maps.get(), maps);
    read.value = Raster<double>(grid_of(window, maps), nan_d);
    const int n = places_across(source, from_maps.get(), read.value.grid);
    const SourceCells cells(source, from_maps.get());
    std::size_t measured = 0;
    for (int r = 0; r < window.n_rows; ++r)
      for (int c = 0; c < window.n_cols; ++c) {
        read.value.at(r, c) = mean_in_cell(cells, maps, window.row0 + r, window.col0 + c, n);
        measured += std::isfinite(read.value.at(r, c));
      }
    require(measured > 0, fmt::format("{}: holds nothing that was measured on the terrain. Check "
                                      "band, nodata and coordinate system.",
                                      source.label));
  }
  read.notes = std::move(source.notes);
  read.warnings = std::move(source.warnings);
  read.identity = std::move(source.identity);
  return read;
}

}  // namespace sturz
