// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/raster_source.hpp"

#include "engine/core/error.hpp"
#include "engine/terrain/raster.hpp"
#include "io/gdal/fill_values.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/gdal/height_unit.hpp"
#include "io/gdal/input_files.hpp"
#include "io/gdal/raster_identity.hpp"

#include <cpl_string.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

/// Of the largest coordinate; closer edges fall together in double precision.
constexpr double smallest_cell_share = 1e-11;

GDALRasterBand& first_band(GDALDataset& dataset, const std::string& label) {
  if (dataset.GetRasterCount() > 0) return *dataset.GetRasterBand(1);
  CPLStringList inner(CSLDuplicate(dataset.GetMetadata("SUBDATASETS")));
  const char* first = inner.FetchNameValue("SUBDATASET_1_NAME");
  throw SetupError(fmt::format(
      "{}: the file itself holds no raster band. {}", label,
      first == nullptr ? "Name a raster file."
                       : fmt::format("Name one of the rasters inside it, e.g. '{}'.", first)));
}

/// Colours are no heights, whatever their numbers.
void refuse_picture(RasterSource& source, GDALDataset& dataset, RasterQuantity quantity) {
  GDALRasterBand& first = *dataset.GetRasterBand(1);
  const GDALDataType type = first.GetRasterDataType();
  if (type != GDT_Byte && type != GDT_UInt16) return;
  const GDALColorInterp meaning = first.GetColorInterpretation();
  const bool palette = type == GDT_Byte && first.GetColorTable() != nullptr;
  const bool colours = meaning == GCI_RedBand || meaning == GCI_HueBand ||
                       meaning == GCI_CyanBand || meaning == GCI_YCbCr_YBand;
  if (palette || colours)
    throw SetupError(fmt::format(
        "{}: is a colour picture ({} bands, the first is {}; no {}). Name the raster "
        "that it was made from.",
        source.label, dataset.GetRasterCount(),
        palette ? "an index into a palette" : GDALGetColorInterpretationName(meaning),
        quantity == RasterQuantity::number ? "numbers of the bed" : "heights or thicknesses"));
  if (type == GDT_Byte && quantity == RasterQuantity::elevation && first.GetScale() == 1)
    source.warnings.push_back(source.label +
                              ": holds whole numbers from 0 to 255 only (8 bits), as pictures do; "
                              "is it a hillshade or a scan instead of heights?");
}

void read_values(RasterSource& source, GDALRasterBand& band) {
  const int nx = source.n_cols, ny = source.n_rows;
  source.values.resize(static_cast<std::size_t>(nx) * ny);
  const auto read = [&](GDALRasterBand& from, void* to, GDALDataType type) {
    if (from.RasterIO(GF_Read, source.col0, source.row0, nx, ny, to, nx, ny, type, 0, 0, nullptr) !=
        CE_None)
      throw SetupError(fmt::format("{}: cannot be read ({}). Is the file complete?", source.label,
                                   gdal_reason()));
  };
  CPLErrorReset();
  read(band, source.values.data(), GDT_Float64);
  if (band.GetMaskFlags() & GMF_ALL_VALID) return;
  std::vector<unsigned char> mask(source.values.size());
  read(*band.GetMaskBand(), mask.data(), GDT_Byte);
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask[i] == 0) source.values[i] = nan_d;
}

/// The step between neighbouring heights of a file that stores whole numbers only.
double quantum_of(const RasterSource& source, double metres_per_stored) {
  const bool whole = std::all_of(source.values.begin(), source.values.end(), [](double v) {
    return std::isnan(v) || (std::abs(v) < 1e9 && v == std::nearbyint(v));
  });
  return whole ? std::abs(metres_per_stored) : 0;
}

/// Stored values become metres upwards.
void convert_to_metres(RasterSource& source, GDALRasterBand& band, const HeightUnit& unit) {
  const double scale = band.GetScale(), offset = band.GetOffset();
  const double metres = unit.down ? -unit.metres : unit.metres;
  source.quantum_m = quantum_of(source, scale * metres);
  if (scale == 1 && offset == 0 && metres == 1) return;
  for (double& v : source.values) {
    v = (v * scale + offset) * metres;
    if (!std::isfinite(v)) v = nan_d;  // a scale beyond all sense
  }
}

/// Tells which heights came of depths, for a direction is easily tagged wrongly.
void warn_of_depths(RasterSource& source) {
  double lowest = INFINITY, highest = -INFINITY;
  for (const double v : source.values) {
    if (std::isnan(v)) continue;
    lowest = std::min(lowest, v);
    highest = std::max(highest, v);
  }
  source.warnings.push_back(fmt::format(
      "{}: the vertical axis of its coordinate system points down, so its values are depths; "
      "turned into heights of {:.6g} to {:.6g} m. If they are heights already, name the system "
      "without its vertical part in terrain.crs",
      source.label, lowest, highest));
}

void read_heights(RasterSource& source, GDALRasterBand& band, const HeightUnit& unit,
                  RasterQuantity quantity) {
  read_values(source, band);
  blank_marks(source, band.GetRasterDataType(), band.GetScale() != 1 || band.GetOffset() != 0);
  convert_to_metres(source, band, unit);
  if (quantity == RasterQuantity::elevation) blank_beyond_earth(source);
  if (unit.down) warn_of_depths(source);
}

/// Makes rows run south and columns east, as everything else here expects.
void turn_values(RasterSource& source, bool rows, bool columns) {
  const int nx = source.n_cols, ny = source.n_rows;
  auto row = [&](int r) { return source.values.begin() + static_cast<std::ptrdiff_t>(r) * nx; };
  if (rows)
    for (int top = 0, bottom = ny - 1; top < bottom; ++top, --bottom)
      std::swap_ranges(row(top), row(top) + nx, row(bottom));
  if (columns)
    for (int r = 0; r < ny; ++r) std::reverse(row(r), row(r) + nx);
}

SourceExtent extent_of(const RasterSource& s) {
  SourceExtent e{s.x_of(0, 0), s.x_of(0, 0), s.y_of(0, 0), s.y_of(0, 0),
                 std::max(s.col_step(), s.row_step())};
  for (const auto& [col, row] : {std::pair{0, s.n_rows}, {s.n_cols, 0}, {s.n_cols, s.n_rows}}) {
    e.min_x = std::min(e.min_x, s.x_of(col, row));
    e.max_x = std::max(e.max_x, s.x_of(col, row));
    e.min_y = std::min(e.min_y, s.y_of(col, row));
    e.max_y = std::max(e.max_y, s.y_of(col, row));
  }
  return e;
}

void refuse_absurd_placement(const RasterSource& source) {
  double farthest = 0;
  for (const int col : {0, source.n_cols})
    for (const int row : {0, source.n_rows})
      farthest =
          std::max({farthest, std::abs(source.x_of(col, row)), std::abs(source.y_of(col, row))});
  require(farthest <= farthest_coordinate,
          fmt::format("{}: reaches out to coordinate {:g} (no place on the earth; a broken "
                      "geotransform). Georeference it again.",
                      source.label, farthest));
  const double step = std::min(source.col_step(), source.row_step());
  require(step > smallest_cell_share * std::max(farthest, 1.0),
          fmt::format("{}: its cells are {:g} wide (too small to be told apart; a broken "
                      "geotransform). Georeference it again.",
                      source.label, step));
}

void read_placement(RasterSource& source, GDALDataset& dataset) {
  if (dataset.GetGeoTransform(source.affine.data()) != CE_None)
    throw SetupError(fmt::format(
        "{}: the file does not say where it lies (no geotransform{}). Georeference it, e.g. with "
        "`gdal_translate -a_ullr` or `gdalwarp`.",
        source.label, dataset.GetGCPCount() > 0 ? ", only control points" : ""));
  const auto& a = source.affine;
  const double determinant = a[1] * a[5] - a[2] * a[4];
  const bool finite = std::all_of(a.begin(), a.end(), [](double v) { return std::isfinite(v); });
  require(finite && determinant != 0,
          source.label + ": its cells have no area (broken geotransform). Georeference it again.");
  refuse_absurd_placement(source);
}

}  // namespace

double RasterSource::col_step() const { return std::hypot(affine[1], affine[4]); }
double RasterSource::row_step() const { return std::hypot(affine[2], affine[5]); }

void require_raster_size(double n_cols, double n_rows, const std::string& label, double most) {
  require(n_cols * n_rows <= most && n_cols < std::numeric_limits<int>::max() &&
              n_rows < std::numeric_limits<int>::max(),
          fmt::format("{}: {:.0f} x {:.0f} cells are too many (at most {:.0f} million). Cut the "
                      "area out or use larger cells.",
                      label, n_cols, n_rows, most / 1e6));
}

namespace {

/// \return the settled system with its vertical part
OGRSpatialReference settle_source(RasterSource& source, const RasterRequest& request,
                                  const OGRSpatialReference* own, bool crs_optional) {
  const bool bare = crs_optional && request.crs.empty() && (own == nullptr || own->IsEmpty());
  if (bare) return OGRSpatialReference();
  std::string note;
  SettledCrs settled = settle_crs(
      own,
      {source.label, request.crs_key, request.crs, request.fallback_crs_key, request.fallback_crs},
      extent_of(source), note);
  if (!note.empty()) source.notes.push_back(note);
  source.crs = settled.crs;
  return settled.full;
}

}  // namespace

OpenRaster::OpenRaster(const RasterRequest& request, RasterQuantity quantity, bool crs_optional)
    : quantity_(quantity) {
  const GdalScope scope;
  const InputFile file = find_input(request.key, request.path, request.directory);
  dataset_ = open_dataset(file.path, file.label, GDAL_OF_RASTER);
  RasterSource& source = about_;
  source.label = file.label;
  GDALDataset& dataset = *dataset_.dataset;
  GDALRasterBand& band = first_band(dataset, source.label);
  refuse_picture(source, dataset, quantity);
  source.n_cols = dataset.GetRasterXSize();
  source.n_rows = dataset.GetRasterYSize();
  source.max_cells = request.max_cells;
  read_placement(source, dataset);
  const OGRSpatialReference* own = dataset.GetSpatialRef();
  const OGRSpatialReference settled = settle_source(source, request, own, crs_optional);
  if (dataset.GetRasterCount() > 1)
    source.notes.push_back(
        fmt::format("{}: band 1 of {} is used", source.label, dataset.GetRasterCount()));
  if (quantity != RasterQuantity::number)
    unit_ = height_unit(settled, own, band.GetUnitType(), source.label);
  unit_.down = unit_.down && quantity == RasterQuantity::elevation;  // a thickness has no direction
  if (!unit_.note.empty()) source.notes.push_back(unit_.note);
  if (!unit_.warning.empty()) source.warnings.push_back(unit_.warning);
  source.identity = {request.key,
                     file.path,
                     raster_shape(source.n_cols, source.n_rows, source.affine, source.crs),
                     {}};
  turn_north_up();
}

/// Placement only: rows run south and columns east, as everything else here expects.
void OpenRaster::turn_north_up() {
  if (!about_.is_axis_aligned()) return;
  auto& a = about_.affine;
  south_up_ = a[5] > 0;
  east_to_west_ = a[1] < 0;
  if (south_up_) {
    a[3] += about_.n_rows * a[5];
    a[5] = -a[5];
    about_.notes.push_back(about_.label + ": stored south-up, turned north-up");
  }
  if (east_to_west_) {
    a[0] += about_.n_cols * a[1];
    a[1] = -a[1];
    about_.notes.push_back(about_.label + ": stored east to west, turned west to east");
  }
}

RasterSource OpenRaster::read(const Window& w, bool identified) {
  const GdalScope scope;
  expect(whole().contains(w), "a window lies on its raster");
  require_raster_size(w.n_cols, w.n_rows, about_.label, about_.max_cells);
  RasterSource source = about_;
  source.n_cols = w.n_cols, source.n_rows = w.n_rows;
  source.col0 = east_to_west_ ? about_.n_cols - w.end_col() : w.col0;
  source.row0 = south_up_ ? about_.n_rows - w.end_row() : w.row0;
  source.affine[0] = about_.x_of(w.col0, w.row0);
  source.affine[3] = about_.y_of(w.col0, w.row0);
  read_heights(source, *dataset_->GetRasterBand(1), unit_, quantity_);
  if (identified)
    source.identity.parts =
        block_hashes(source.values, {source.col0, source.row0, w.n_cols, w.n_rows}, about_.n_cols,
                     about_.n_rows);
  turn_values(source, south_up_, east_to_west_);
  return source;
}

std::map<std::string, std::string> OpenRaster::hashes_of(const std::vector<std::string>& parts) {
  const GdalScope scope;
  std::map<std::pair<int, int>, std::vector<ReadWindow>> in_order;  // as files mostly store them
  for (const std::string& name : parts)
    if (const auto at = window_of_part(name, about_.n_cols, about_.n_rows))
      in_order[{at->row0, at->col0}].push_back(*at);
  std::map<std::string, std::string> hashes;
  RasterSource part = about_;
  GDALRasterBand& band = *dataset_->GetRasterBand(1);
  for (const auto& [first, windows] : in_order)
    for (const ReadWindow& at : windows) {
      part.col0 = at.col0, part.row0 = at.row0;
      part.n_cols = at.n_cols, part.n_rows = at.n_rows;
      read_values(part, band);
      blank_marks(part, band.GetRasterDataType(), band.GetScale() != 1 || band.GetOffset() != 0);
      convert_to_metres(part, band, unit_);
      if (quantity_ == RasterQuantity::elevation)
        for (double& v : part.values)  // whether that is all there is was asked of larger parts
          if (v < lowest_ground_m || v > highest_ground_m) v = nan_d;
      hashes.merge(block_hashes(part.values, at, about_.n_cols, about_.n_rows));
    }
  return hashes;
}

RasterSource read_source(const RasterRequest& request, RasterQuantity quantity, bool crs_optional) {
  OpenRaster raster(request, quantity, crs_optional);
  return raster.read(raster.whole());
}

}  // namespace sturz
