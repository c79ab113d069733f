// SPDX-License-Identifier: Apache-2.0
#include "io/site/thickness_raster.hpp"

#include "engine/core/error.hpp"
#include "engine/core/vec.hpp"
#include "io/doubts/release_doubts.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/gdal/raster_identity.hpp"
#include "io/gdal/raster_source.hpp"
#include "io/site/polygon_cover.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace sturz {
namespace {

/// Volumes below this share of the whole are round-off, not a part that lies outside.
constexpr double volume_round_off = 1e-9;

/// A polygon of few corners. A quadrilateral cut by two strips has at most eight; one that a
/// transformation folded over itself gains half as many with each cut, 19 in the end.
struct Patch {
  std::array<Vec2, 20> corner;
  int n = 0;
  void add(const Vec2& p) { corner[static_cast<std::size_t>(n++)] = p; }
  double area() const { return std::abs(ring_area({corner.data(), static_cast<std::size_t>(n)})); }
};

/// The part of `patch` where sign * (coordinate - limit) >= 0 (Sutherland-Hodgman).
Patch cut(const Patch& patch, int axis, double limit, double sign) {
  Patch kept;
  for (int i = 0; i < patch.n; ++i) {
    const Vec2& a = patch.corner[static_cast<std::size_t>(i)];
    const Vec2& b = patch.corner[static_cast<std::size_t>((i + 1) % patch.n)];
    const double da = sign * (a[axis] - limit), db = sign * (b[axis] - limit);
    if (da >= 0) kept.add(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) kept.add(a + (b - a) * (da / (da - db)));
  }
  return kept;
}

/// Source cells that found no place on the terrain.
struct Lost {
  double volume = 0;
  double min_x = INFINITY, max_x = -INFINITY, min_y = INFINITY, max_y = -INFINITY;

  void add(double v, const Patch& where) {
    volume += v;
    for (int i = 0; i < where.n; ++i) {
      const Vec2& p = where.corner[static_cast<std::size_t>(i)];
      min_x = std::min(min_x, p.x());
      max_x = std::max(max_x, p.x());
      min_y = std::min(min_y, p.y());
      max_y = std::max(max_y, p.y());
    }
  }
};

/// Spreads `volume` over the cells under `patch`, given in cells of the grid (u east, v south).
/// \param volumes on the window `at` of the grid, which holds the patch as far as it lies on the
/// grid \return the volume that fell inside
double spread(const Patch& patch, double volume, const Grid& g, const Window& at,
              Raster<double>& volumes) {
  double lo[2]{INFINITY, INFINITY}, hi[2]{-INFINITY, -INFINITY};
  for (int i = 0; i < patch.n; ++i)
    for (int axis = 0; axis < 2; ++axis) {
      lo[axis] = std::min(lo[axis], patch.corner[static_cast<std::size_t>(i)][axis]);
      hi[axis] = std::max(hi[axis], patch.corner[static_cast<std::size_t>(i)][axis]);
    }
  const auto first = [](double v, int n) {
    return static_cast<int>(std::floor(std::clamp(v, 0.0, static_cast<double>(n))));
  };
  const auto end = [](double v, int n) {
    return static_cast<int>(std::ceil(std::clamp(v, 0.0, static_cast<double>(n))));
  };
  const double area = patch.area();
  if (!(area > 0)) return 0;
  const double per_area = volume / area;
  double inside = 0;
  for (int r = first(lo[1], g.n_rows); r < end(hi[1], g.n_rows); ++r) {
    const Patch strip = cut(cut(patch, 1, r, 1), 1, r + 1.0, -1);
    for (int c = first(lo[0], g.n_cols); c < end(hi[0], g.n_cols); ++c) {
      const double part = per_area * cut(cut(strip, 0, c, 1), 0, c + 1.0, -1).area();
      volumes.at(r - at.row0, c - at.col0) += part;
      inside += part;
    }
  }
  return inside;
}

/// What a search through the whole file found, part by part.
struct Survey {
  Window box;  ///< of the cells with thickness
  std::size_t positive = 0, negative = 0;
  double first_negative = 0;
  int negative_row = 0, negative_col = 0;

  void add(const RasterSource& s, const Window& at) {
    std::size_t i = 0;
    for (int r = at.row0; r < at.end_row(); ++r)
      for (int c = at.col0; c < at.end_col(); ++c, ++i) {
        const double v = s.values[i];
        if (v > 0) {
          ++positive;
          if (!box.contains(r, c)) box = joined(box, {r, c, 1, 1});
        } else if (v < 0 && negative++ == 0) {
          first_negative = v, negative_row = r, negative_col = c;
        }
      }
  }
};

void refuse_negative(const Survey& found, const RasterSource& whole) {
  if (found.negative == 0) return;
  const int row = found.negative_row, col = found.negative_col;
  throw SetupError(fmt::format(
      "{}: thickness {:g} m at row {}, column {} (x {:.10g}, y {:.10g}; rows from the north, from "
      "0)"
      " is negative{}",
      whole.label, found.first_negative, row, col, whole.x_of(col + 0.5, row + 0.5),
      whole.y_of(col + 0.5, row + 0.5),
      found.positive == 0
          ? fmt::format(", like all its {} values. If these are depths counted downwards, "
                        "set `release.thickness_factor: -1`.",
                        found.negative)
          : ". Set such cells to nodata or zero."));
}

/// Square metres of a source cell, 0 if its system has no metres (degrees).
double own_cell_area(const RasterSource& s) {
  if (s.crs.IsGeographic()) return 0;
  const double unit = s.crs.IsEmpty() ? 1 : s.crs.GetLinearUnits();
  return std::abs(s.affine[1] * s.affine[5] - s.affine[2] * s.affine[4]) * unit * unit;
}

/// A source cell in cells of the grid (u east, v south).
Patch cell_on_grid(const RasterSource& s, int col, int row, OGRCoordinateTransformation* transform,
                   const Grid& g) {
  std::array<double, 4> x{}, y{};
  for (int k = 0; k < 4; ++k) {
    const double c = col + (k == 1 || k == 2), r = row + (k > 1);
    x[static_cast<std::size_t>(k)] = s.x_of(c, r);
    y[static_cast<std::size_t>(k)] = s.y_of(c, r);
  }
  require(transform == nullptr || transform->Transform(4, x.data(), y.data()) != 0,
          fmt::format("{}: the cell at row {}, column {} cannot be moved to the terrain's system. "
                      "Check release.crs.",
                      s.label, row, col));
  Patch patch;
  for (std::size_t k = 0; k < 4; ++k) {
    require(std::isfinite(x[k]) && std::isfinite(y[k]),
            fmt::format("{}: the cell at row {}, column {} lies nowhere in the terrain's system. "
                        "Check release.crs.",
                        s.label, row, col));
    patch.add({(x[k] - g.west_m) / g.cell_m, (g.north_m - y[k]) / g.cell_m});
  }
  return patch;
}

void refuse_lost(const Lost& lost, double total, const Grid& g, const std::string& label) {
  if (lost.volume <= volume_round_off * total) return;
  throw SetupError(fmt::format(
      "{}: {:.6g} of {:.6g} m3 ({:.3g} %) lie outside the terrain, in cells within x {:.10g} to "
      "{:.10g}, y {:.10g} to {:.10g} (terrain x {:.10g} to {:.10g}, y {:.10g} to {:.10g}). Use a "
      "larger terrain or cut the raster.",
      label, lost.volume, total, 100 * lost.volume / total, g.west_m + lost.min_x * g.cell_m,
      g.west_m + lost.max_x * g.cell_m, g.north_m - lost.max_y * g.cell_m,
      g.north_m - lost.min_y * g.cell_m, g.west_m, g.east_m(), g.south_m(), g.north_m));
}

/// \param s the whole file
bool is_same_grid(const RasterSource& s, const Grid& g, bool moved) {
  return !moved && s.is_axis_aligned() && s.n_cols == g.n_cols && s.n_rows == g.n_rows &&
         s.affine[0] == g.west_m && s.affine[3] == g.north_m && s.affine[1] == g.cell_m &&
         s.affine[5] == -g.cell_m;
}

/// The cells of the grid that the source's thickness may touch.
Window window_under(const RasterSource& s, OGRCoordinateTransformation* transform, const Grid& g) {
  double lo[2]{INFINITY, INFINITY}, hi[2]{-INFINITY, -INFINITY};
  for (int row = 0; row < s.n_rows; ++row)
    for (int col = 0; col < s.n_cols; ++col) {
      if (!(s.values[static_cast<std::size_t>(row) * s.n_cols + col] > 0)) continue;
      const Patch patch = cell_on_grid(s, col, row, transform, g);
      for (int i = 0; i < patch.n; ++i)
        for (int axis = 0; axis < 2; ++axis) {
          lo[axis] = std::min(lo[axis], patch.corner[static_cast<std::size_t>(i)][axis]);
          hi[axis] = std::max(hi[axis], patch.corner[static_cast<std::size_t>(i)][axis]);
        }
    }
  return cells_under(g.west_m + lo[0] * g.cell_m, g.west_m + hi[0] * g.cell_m,
                     g.north_m - hi[1] * g.cell_m, g.north_m - lo[1] * g.cell_m, g);
}

/// Volumes per terrain cell, and the totals in `result`.
/// \param may_reach_beyond what lies outside the terrain is left out; else it is refused
void carry_over(const RasterSource& s, OGRCoordinateTransformation* transform, const Grid& g,
                bool may_reach_beyond, ThicknessRead& result) {
  const Window at = window_under(s, transform, g);
  result.thickness = Raster<double>(grid_of(at, g), 0.0);
  Raster<double>& volumes = result.thickness;
  const double own_area = own_cell_area(s);
  Lost lost;
  double placed = 0, all = 0;
  for (int row = 0; row < s.n_rows; ++row)
    for (int col = 0; col < s.n_cols; ++col) {
      const double thickness = s.values[static_cast<std::size_t>(row) * s.n_cols + col];
      if (!(thickness > 0)) continue;
      const Patch patch = cell_on_grid(s, col, row, transform, g);
      const double area = own_area > 0 ? own_area : patch.area() * g.cell_m * g.cell_m;
      const double volume = thickness * area, inside = spread(patch, volume, g, at, volumes);
      const double counts = may_reach_beyond ? inside : volume;
      result.volume_m3 += counts;
      result.area_m2 += area * counts / volume;
      all += volume;
      placed += inside;
      if (volume - inside > volume_round_off * volume) lost.add(volume - inside, patch);
    }
  require(all > 0,
          s.label + ": holds no thickness above zero (an empty release). Check band and nodata.");
  if (!may_reach_beyond || !(placed > 0)) refuse_lost(lost, all, g, s.label);
  const double correction = result.volume_m3 / placed, cell_area = g.cell_m * g.cell_m;
  for (double& v : volumes.values) v *= correction / cell_area;
  result.notes.push_back(fmt::format(
      "{}: carried over by overlapping areas; {:.9g} m3 over {:.9g} m2, volume corrected by "
      "{:+.2g} %",
      s.label, result.volume_m3, result.area_m2, (correction - 1) * 100));
}

}  // namespace

namespace {

/// Larger files are searched in strips, and only what lies around their thickness is kept.
constexpr double most_at_once = 16e6;

/// What is kept of a file with depths.
struct Depths {
  RasterSource whole;   ///< without values
  RasterSource source;  ///< of `at`
  Window at;
};

Depths read_depths(const RasterRequest& request, bool terrain_is_local) {
  OpenRaster raster(request, RasterQuantity::thickness, terrain_is_local);
  Depths depths{raster.about(), RasterSource(), raster.whole()};
  const auto factored = [&](const Window& w) {
    RasterSource source = raster.read(w);
    if (request.factor != 1)
      for (double& v : source.values) v *= request.factor;
    return source;
  };
  Survey found;
  const Window all = raster.whole();
  if (static_cast<double>(all.n_cells()) <= most_at_once) {
    depths.source = factored(all);
    found.add(depths.source, all);
    refuse_negative(found, depths.whole);
    if (!request.is_scaled_later)
      refuse_mask(depths.source.values, request.factor, depths.whole.label);
    return depths;
  }
  std::map<std::string, std::string> parts;
  for (int row = 0; row < all.n_rows; row += identity_block) {
    const Window strip{row, 0, std::min(identity_block, all.n_rows - row), all.n_cols};
    RasterSource source = factored(strip);
    found.add(source, strip);
    parts.merge(source.identity.parts);
  }
  refuse_negative(found, depths.whole);
  if (found.box.n_cells() > 0)
    depths.at = found.box;
  else
    depths.at = {0, 0, 1, 1};
  depths.source = factored(depths.at);
  depths.source.identity.parts = std::move(parts);
  if (!request.is_scaled_later)
    refuse_mask(depths.source.values, request.factor, depths.whole.label);
  return depths;
}

/// The terrain's own cells: nothing is carried over.
void take_cells(const Depths& depths, const Grid& terrain, ThicknessRead& result) {
  const RasterSource& s = depths.source;
  Survey found;
  found.add(s, depths.at);
  require(found.positive > 0,
          s.label + ": holds no thickness above zero (an empty release). Check band and nodata.");
  const Window at = widened(found.box, 1, terrain);
  result.thickness = Raster<double>(grid_of(at, terrain), 0.0);
  const double cell_area = terrain.cell_m * terrain.cell_m;
  std::size_t i = 0;
  for (int r = depths.at.row0; r < depths.at.end_row(); ++r)
    for (int c = depths.at.col0; c < depths.at.end_col(); ++c, ++i) {
      if (!(s.values[i] > 0)) continue;
      result.thickness.at(r - at.row0, c - at.col0) = s.values[i];
      result.volume_m3 += s.values[i] * cell_area;
      result.area_m2 += cell_area;
    }
}

}  // namespace

void check_thickness(const RasterRequest& request, bool terrain_is_local) {
  const GdalScope scope;
  read_depths(request, terrain_is_local);
}

ThicknessRead read_thickness(const RasterRequest& request, const Grid& terrain) {
  const GdalScope scope;
  Depths depths = read_depths(request, terrain.crs_wkt.empty());
  RasterSource& source = depths.source;
  ThicknessRead result;
  result.notes = std::move(source.notes);
  result.warnings = std::move(source.warnings);
  result.identity = std::move(source.identity);
  const OGRSpatialReference to = crs_from_wkt(terrain.crs_wkt);
  std::string warning;
  const TransformPtr transform = transform_between(source.crs, to, source.label, &warning);
  if (!warning.empty()) result.warnings.push_back(warning);
  if (to.IsEmpty() && !source.crs.IsEmpty())
    result.notes.push_back(source.label +
                           ": its coordinates are taken as they are, because the terrain has no "
                           "coordinate system");
  if (transform)
    result.notes.push_back(fmt::format("{}: reprojected from {} to {}", source.label,
                                       crs_name(source.crs), crs_name(to)));
  if (is_same_grid(depths.whole, terrain, transform != nullptr))
    take_cells(depths, terrain, result);
  else
    carry_over(source, transform.get(), terrain, request.may_reach_beyond, result);
  double largest = 0;
  for (const double v : source.values) largest = std::max(largest, std::isnan(v) ? 0 : v);
  std::string doubt =
      thickness_doubt(result.volume_m3, result.area_m2, largest, request.factor, source.label);
  if (!doubt.empty()) result.warnings.push_back(std::move(doubt));
  return result;
}

}  // namespace sturz
