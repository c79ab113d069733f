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

/// What the values become: the grid of the whole, and a system to resample into.
struct WorkingGrid {
  Grid grid;
  bool as_it_is = true;    ///< cell by cell; no resampling
  OGRSpatialReference to;  ///< of the grid, where resampled
};

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
  require_raster_size(n_cols, n_rows, label, most_grid_cells);
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

/// \param ratio edge of the target's cells over the source's, along columns and rows
void warp_bilinear(RasterSource& source, const OGRSpatialReference& to,
                   const std::array<double, 2>& ratio, Raster<double>& target) {
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
  // because members may be running beside this. The scale is that of the whole raster: the library
  // would guess another one for every block.
  for (const char* word :
       {"-r", "bilinear", "-et", "0.01", "-wo", "NUM_THREADS=1", "-wo", "INIT_DEST=nan"})
    options.AddString(word);
  options.AddString("-wo");
  options.AddString(fmt::format("XSCALE={:.17g}", 1 / ratio[0]).c_str());
  options.AddString("-wo");
  options.AddString(fmt::format("YSCALE={:.17g}", 1 / ratio[1]).c_str());
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

WorkingGrid resampled_in_place(RasterSource& source, double cell) {
  const bool square = has_square_cells(source);
  const std::string why =
      !source.is_axis_aligned()
          ? "rotated cells"
          : (square ? fmt::format("{:g} m cells", source.affine[1])
                    : fmt::format("{:g} x {:g} m cells", source.affine[1], -source.affine[5]));
  source.notes.push_back(
      fmt::format("{}: resampled bilinearly from {} to {:g} m squares", source.label, why, cell));
  return {grid_over(own_extent(source), cell, source.crs, source), false, source.crs};
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

WorkingGrid reprojected(RasterSource& source, const std::optional<double>& wanted,
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
  const Grid grid = grid_over(outline(source, *transform, cell), cell, to, source);
  source.notes.push_back(
      fmt::format("{}: reprojected from {} to {} because {}; {:g} m cells, bilinear", source.label,
                  crs_name(source.crs), crs_name(to), reason, cell));
  return {grid, false, to};
}

WorkingGrid working_grid(RasterSource& source, const std::optional<double>& wanted) {
  const double col_step = source.col_step(), row_step = source.row_step();
  std::string reason;
  if (!source.crs.IsEmpty() &&  // local coordinates are metres already
      !is_working_crs(source.crs, source.x_of(source.n_cols / 2.0, source.n_rows / 2.0),
                      source.y_of(source.n_cols / 2.0, source.n_rows / 2.0),
                      std::max(col_step, row_step), reason))
    return reprojected(source, wanted, reason);
  const bool own_size = !wanted || same_edge(*wanted, col_step, source.n_cols);
  if (has_square_cells(source) && own_size)
    return {{source.n_cols, source.n_rows, source.affine[0], source.affine[3], source.affine[1],
             crs_wkt2(source.crs)},
            true,
            OGRSpatialReference()};
  return resampled_in_place(source, wanted ? *wanted : std::min(col_step, row_step));
}

/// Edge of the blocks that are resampled one by one, in cells of the working grid: their lattice
/// lies on the grid, so that no window changes a bit.
constexpr int warp_block = 1024;
/// Of these are kept while a raster is open.
constexpr std::size_t most_blocks = 8;
/// Cells of the source that bilinear weights need beyond a block, besides its own width.
constexpr int weight_margin = 6;

}  // namespace

class ElevationRaster::Impl {
 public:
  explicit Impl(const RasterRequest& request)
      : source_(request, RasterQuantity::elevation), about_(source_.about()) {
    require(!request.cell_size_m || *request.cell_size_m > 0,
            fmt::format("terrain.cell_size_m = {:g} (must be positive). Give metres.",
                        request.cell_size_m.value_or(0)));
    working_ = working_grid(about_, request.cell_size_m);
    if (!working_.as_it_is) set_up_warp();
  }

  const Grid& grid() const { return working_.grid; }
  OpenRaster& source() { return source_; }

  RasterRead read(const Window& w, bool identified) {
    expect(whole_of(grid()).contains(w), "a window lies on its grid");
    require_raster_size(w.n_cols, w.n_rows, about_.label, about_.max_cells);
    RasterRead result;
    result.raster = Raster<double>(grid_of(w, grid()), nan_d);
    result.notes = about_.notes;
    result.warnings = about_.warnings;
    result.identity = about_.identity;
    if (working_.as_it_is) {
      RasterSource part = source_.read(w, identified);
      if (identified) doubt(part, w);
      result.raster.values = std::move(part.values);
      add_facts(part, result);
    } else {
      for (int r = w.row0 / warp_block; r * warp_block < w.end_row(); ++r)
        for (int c = w.col0 / warp_block; c * warp_block < w.end_col(); ++c)
          copy_from(block(r, c), w, result);
    }
    return result;
  }

 private:
  struct Block {
    Window at;
    Raster<double> values;
    RasterSource facts;  ///< of the part of the source below it
  };

  /// What reading a part has added to what was known of the whole.
  void add_facts(const RasterSource& part, RasterRead& result) const {
    const RasterSource& whole = source_.about();
    for (std::size_t i = whole.notes.size(); i < part.notes.size(); ++i)
      result.notes.push_back(part.notes[i]);
    for (std::size_t i = whole.warnings.size(); i < part.warnings.size(); ++i)
      result.warnings.push_back(part.warnings[i]);
    result.identity.parts.insert(part.identity.parts.begin(), part.identity.parts.end());
  }

  static void doubt(RasterSource& part, const Window& at) {
    std::vector<std::string> doubts = dem_doubts(part, {at.row0, at.col0});
    std::move(doubts.begin(), doubts.end(), std::back_inserter(part.warnings));
  }

  void copy_from(const Block& from, const Window& w, RasterRead& result) const {
    const int row0 = std::max(w.row0, from.at.row0),
              row1 = std::min(w.end_row(), from.at.end_row());
    const int col0 = std::max(w.col0, from.at.col0),
              col1 = std::min(w.end_col(), from.at.end_col());
    for (int r = row0; r < row1; ++r)
      std::copy_n(&from.values.at(r - from.at.row0, col0 - from.at.col0), col1 - col0,
                  &result.raster.at(r - w.row0, col0 - w.col0));
    add_facts(from.facts, result);
  }

  void set_up_warp() {
    to_source_ = transform_between(working_.to, about_.crs, about_.label);
    const double cell = grid().cell_m;
    // The ratio at the middle of the raster stands for all of it.
    const double x = 0.5 * (grid().west_m + grid().east_m());
    const double y = 0.5 * (grid().south_m() + grid().north_m);
    const auto [u0, v0] = in_source(x, y);
    const auto [u1, v1] = in_source(x + cell, y);
    const auto [u2, v2] = in_source(x, y - cell);
    ratio_ = {std::hypot(u1 - u0, u2 - u0), std::hypot(v1 - v0, v2 - v0)};
    for (double& r : ratio_)  // about one needs no wider weights
      if (!(r > 1e-6) || !std::isfinite(r) || std::abs(r - 1) < 0.05) r = 1;
  }

  /// Column and row in the source of a place on the working grid; not finite where there is none.
  std::array<double, 2> in_source(double x, double y) const {
    if (to_source_ && to_source_->Transform(1, &x, &y) == 0) return {nan_d, nan_d};
    const auto& a = about_.affine;
    const double determinant = a[1] * a[5] - a[2] * a[4];
    const double dx = x - a[0], dy = y - a[3];
    return {(a[5] * dx - a[2] * dy) / determinant, (a[1] * dy - a[4] * dx) / determinant};
  }

  /// The part of the source that a block needs.
  Window source_window(const Grid& block) const {
    double lo[2]{INFINITY, INFINITY}, hi[2]{-INFINITY, -INFINITY};
    constexpr int pieces = 16;
    for (int i = 0; i <= pieces; ++i)
      for (int j = 0; j <= pieces; ++j) {
        const double x = block.west_m + (block.east_m() - block.west_m) * i / pieces;
        const double y = block.south_m() + (block.north_m - block.south_m()) * j / pieces;
        const auto at = in_source(x, y);
        for (std::size_t k = 0; k < 2; ++k)
          if (std::isfinite(at[k])) lo[k] = std::min(lo[k], at[k]), hi[k] = std::max(hi[k], at[k]);
      }
    if (!(lo[0] <= hi[0] && lo[1] <= hi[1])) return {};
    // Between the points looked at an outline may bulge.
    const double mu = weight_margin + 2 * ratio_[0] + 0.02 * (hi[0] - lo[0]);
    const double mv = weight_margin + 2 * ratio_[1] + 0.02 * (hi[1] - lo[1]);
    const auto cell = [](double at, int n) {
      return static_cast<int>(std::floor(std::clamp(at, -1.0, n + 1.0)));
    };
    return window_between(cell(lo[1] - mv, about_.n_rows), cell(hi[1] + mv, about_.n_rows) + 1,
                          cell(lo[0] - mu, about_.n_cols), cell(hi[0] + mu, about_.n_cols) + 1,
                          {about_.n_cols, about_.n_rows, 0, 0, 1, ""});
  }

  const Block& block(int row, int col) {
    for (const auto& known : blocks_)
      if (known->at.row0 == row * warp_block && known->at.col0 == col * warp_block) return *known;
    auto made = std::make_unique<Block>();
    made->at = window_between(row * warp_block, (row + 1) * warp_block, col * warp_block,
                              (col + 1) * warp_block, grid());
    made->values = Raster<double>(grid_of(made->at, grid()), nan_d);
    const Window below = source_window(made->values.grid);
    if (below.n_cells() > 0) {
      made->facts = source_.read(below);
      doubt(made->facts, below);
      warp_bilinear(made->facts, working_.to, ratio_, made->values);
      made->facts.values = {};
    }
    if (blocks_.size() >= most_blocks) blocks_.erase(blocks_.begin());
    blocks_.push_back(std::move(made));
    return *blocks_.back();
  }

  OpenRaster source_;
  RasterSource about_;  ///< with what was decided on the working grid
  WorkingGrid working_;
  TransformPtr to_source_;
  std::array<double, 2> ratio_{1, 1};
  std::vector<std::unique_ptr<Block>> blocks_;
};

ElevationRaster::ElevationRaster(const RasterRequest& request) {
  const GdalScope scope;
  impl_ = std::make_unique<Impl>(request);
}
ElevationRaster::~ElevationRaster() = default;
const Grid& ElevationRaster::grid() const { return impl_->grid(); }
RasterRead ElevationRaster::read(const Window& w) {
  const GdalScope scope;
  return impl_->read(w, true);
}
Raster<double> ElevationRaster::look(const Window& w) {
  const GdalScope scope;
  return impl_->read(w, false).raster;
}
std::map<std::string, std::string> ElevationRaster::hashes_of(
    const std::vector<std::string>& parts) {
  return impl_->source().hashes_of(parts);
}

RasterRead read_elevation(const RasterRequest& request) {
  ElevationRaster raster(request);
  RasterRead result = raster.read(whole_of(raster.grid()));
  const auto& values = result.raster.values;
  require(std::any_of(values.begin(), values.end(), [](double v) { return !std::isnan(v); }),
          fmt::format("{} = {}: holds no valid cell (all of it is nodata). Check band and nodata "
                      "value.",
                      request.key, request.path));
  return result;
}

}  // namespace sturz
