// SPDX-License-Identifier: Apache-2.0
#include "io/site/bed/bed_raster.hpp"

#include "engine/core/error.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/gdal/raster_identity.hpp"
#include "io/gdal/raster_source.hpp"
#include "scenarios/schema/number_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sturz {
namespace {

/// A centre that lies on the edge of two cells belongs to the eastern or southern one, whatever the
/// last digits say.
constexpr double edge_of_cell = 1e-6;

/// What a look through the whole file found.
struct Survey {
  std::size_t known = 0, outside = 0;
  double first = 0, least = INFINITY, most = -INFINITY;
  int row = 0, col = 0;                ///< of the first value outside
  double least_at[2]{}, most_at[2]{};  ///< column and row of the extremes
};

bool in_range(const KeyInfo& key, double v) {
  return (key.above_min ? v > key.min : v >= key.min) && v <= key.max;
}

void add(Survey& found, const RasterSource& s, const Window& at, const KeyInfo& key) {
  std::size_t i = 0;
  for (int r = at.row0; r < at.end_row(); ++r)
    for (int c = at.col0; c < at.end_col(); ++c, ++i) {
      const double v = s.values[i];
      if (std::isnan(v)) continue;
      ++found.known;
      if (v < found.least) found.least = v, found.least_at[0] = c, found.least_at[1] = r;
      if (v > found.most) found.most = v, found.most_at[0] = c, found.most_at[1] = r;
      if (!in_range(key, v) && found.outside++ == 0) found.first = v, found.row = r, found.col = c;
    }
}

std::string unit_text(const KeyInfo& key) { return key.units == "1" ? "" : " " + key.units; }

std::string cell_text(const RasterSource& s, double col, double row) {
  return fmt::format("row {:g}, column {:g} (x {:.10g}, y {:.10g}; rows from the north, from 0)",
                     row, col, s.x_of(col + 0.5, row + 0.5), s.y_of(col + 0.5, row + 0.5));
}

void refuse_values(const Survey& found, const RasterSource& s, const BedRasterLimits& limits) {
  const KeyInfo& key = *limits.key;
  require(found.known > 0,
          s.label + ": holds no value (all of it is nodata). Check band and nodata value.");
  if (found.outside > 0)
    throw SetupError(fmt::format(
        "{}: {:g}{} at {} must be {}, as {}{}. Correct it or set such cells to nodata.", s.label,
        found.first, unit_text(key), cell_text(s, found.col, found.row), range_text(key), key.path,
        found.outside == 1 ? "" : fmt::format("; so are {} values more", found.outside - 1)));
  const auto refuse_product = [&](double factor, double value, const double* at) {
    if (in_range(key, factor * value)) return;
    throw SetupError(
        fmt::format("{}: {:g}{} at {} becomes {:g} with {} = {:g} (must be {}). Give "
                    "the factor less room or correct the raster.",
                    s.label, value, unit_text(key), cell_text(s, at[0], at[1]), factor * value,
                    limits.factor_key, factor, range_text(key)));
  };
  refuse_product(limits.factor.second, found.most, found.most_at);
  refuse_product(limits.factor.first, found.least, found.least_at);
}

/// Strip by strip, so that never more than one is held. \return the identity's parts
std::map<std::string, std::string> survey(OpenRaster& raster, const BedRasterLimits& limits,
                                          std::vector<std::string>& notes) {
  Survey found;
  std::map<std::string, std::string> parts;
  const Window all = raster.whole();
  const RasterSource whole = raster.about();
  for (int row = 0; row < all.n_rows; row += identity_block) {
    const Window strip{row, 0, std::min(identity_block, all.n_rows - row), all.n_cols};
    RasterSource source = raster.read(strip);
    add(found, source, strip, *limits.key);
    parts.merge(source.identity.parts);
    if (row == 0) notes = source.notes;
  }
  refuse_values(found, whole, limits);
  return parts;
}

}  // namespace

KnownRange known_range(const Raster<double>& raster) {
  KnownRange out{0, INFINITY, -INFINITY, 0};
  for (const double v : raster.values) {
    if (std::isnan(v)) continue;
    ++out.count;
    out.least = std::min(out.least, v), out.most = std::max(out.most, v);
    out.mean += v;
  }
  if (out.count == 0) return {0, nan_d, nan_d, nan_d};
  out.mean /= static_cast<double>(out.count);
  return out;
}

class BedRasterFile::Impl {
 public:
  Impl(const RasterRequest& request, const BedRasterLimits& limits, const Grid& terrain,
       BedRasterFile& told)
      : raster_(request, RasterQuantity::number, terrain.crs_wkt.empty()), terrain_(terrain) {
    const RasterSource& about = raster_.about();
    told.identity = about.identity;
    told.warnings = about.warnings;
    told.identity.parts = survey(raster_, limits, told.notes);
    const OGRSpatialReference on = crs_from_wkt(terrain.crs_wkt);
    std::string warning;
    to_source_ = transform_between(on, about.crs, about.label, &warning);
    if (!warning.empty()) told.warnings.push_back(warning);
    if (on.IsEmpty() && !about.crs.IsEmpty())
      told.notes.push_back(about.label +
                           ": its coordinates are taken as they are, because the terrain has no "
                           "coordinate system");
    if (to_source_)
      told.notes.push_back(fmt::format("{}: looked up in {} from {}", about.label,
                                       crs_name(about.crs), crs_name(on)));
  }

  const std::string& label() const { return raster_.about().label; }

  Raster<double> on(const Window& w) {
    Raster<double> out(grid_of(w, terrain_), nan_d);
    for (int row = 0; row < w.n_rows; row += identity_block)
      fill(w, row, std::min(w.n_rows, row + identity_block), out);
    return out;
  }

 private:
  /// Rows row0 up to row1 of a window.
  void fill(const Window& w, int row0, int row1, Raster<double>& out) {
    const RasterSource& about = raster_.about();
    const auto n = static_cast<std::size_t>(w.n_cols);
    std::vector<int> col(n * static_cast<std::size_t>(row1 - row0), -1), row(col.size(), -1);
    Window needed;
    for (int r = row0; r < row1; ++r) {
      const std::size_t first = static_cast<std::size_t>(r - row0) * n;
      locate(w, r, &col[first], &row[first]);
      for (std::size_t c = first; c < first + n; ++c)
        if (col[c] >= 0) {
          if (!needed.contains(row[c], col[c])) needed = joined(needed, {row[c], col[c], 1, 1});
        }
    }
    if (needed.n_cells() == 0) return;
    const RasterSource source = raster_.read(needed, false);
    expect(about.n_cols >= needed.n_cols, "a window lies on its raster");
    for (std::size_t i = 0; i < col.size(); ++i)
      if (col[i] >= 0)
        out.values[static_cast<std::size_t>(row0) * n + i] =
            source.values[static_cast<std::size_t>(row[i] - needed.row0) * needed.n_cols +
                          (col[i] - needed.col0)];
  }

  /// Columns and rows of the file below the centres of one row of the window; -1 beyond it.
  void locate(const Window& w, int r, int* col, int* row) {
    const RasterSource& s = raster_.about();
    const auto n = static_cast<std::size_t>(w.n_cols);
    std::vector<double> x(n), y(n);
    std::vector<int> good(n, 1);
    for (std::size_t c = 0; c < n; ++c) {
      x[c] = terrain_.x_center(w.col0 + static_cast<int>(c));
      y[c] = terrain_.y_center(w.row0 + r);
    }
    if (to_source_) to_source_->Transform(w.n_cols, x.data(), y.data(), nullptr, good.data());
    const auto& a = s.affine;
    const double determinant = a[1] * a[5] - a[2] * a[4];
    for (std::size_t c = 0; c < n; ++c) {
      const double dx = x[c] - a[0], dy = y[c] - a[3];
      const double u = std::floor((a[5] * dx - a[2] * dy) / determinant + edge_of_cell);
      const double v = std::floor((a[1] * dy - a[4] * dx) / determinant + edge_of_cell);
      if (!good[c] || !(u >= 0 && u < s.n_cols && v >= 0 && v < s.n_rows)) continue;
      col[c] = static_cast<int>(u), row[c] = static_cast<int>(v);
    }
  }

  OpenRaster raster_;
  Grid terrain_;
  TransformPtr to_source_;
};

BedRasterFile::BedRasterFile(const RasterRequest& request, const BedRasterLimits& limits,
                             const Grid& terrain) {
  const GdalScope scope;
  impl_ = std::make_unique<Impl>(request, limits, terrain, *this);
}
BedRasterFile::~BedRasterFile() = default;
const std::string& BedRasterFile::label() const { return impl_->label(); }
Raster<double> BedRasterFile::on(const Window& w) const {
  const GdalScope scope;
  return impl_->on(w);
}

void check_bed_raster(const RasterRequest& request, const BedRasterLimits& limits,
                      bool terrain_is_local) {
  const GdalScope scope;
  OpenRaster raster(request, RasterQuantity::number, terrain_is_local);
  std::vector<std::string> notes;
  survey(raster, limits, notes);
}

}  // namespace sturz
