// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/raster_source.hpp"

#include "engine/core/error.hpp"
#include "engine/terrain/raster.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/gdal/input_files.hpp"

#include <cpl_string.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr double foot = 0.3048, survey_foot = 1200.0 / 3937.0;
constexpr double deepest_elevation_m = -12000;  // below the deepest sea: a mark, not a place
constexpr double largest_value = 1e30;
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

void read_values(RasterSource& source, GDALRasterBand& band) {
  const int nx = source.n_cols, ny = source.n_rows;
  source.values.resize(static_cast<std::size_t>(nx) * ny);
  const auto read = [&](GDALRasterBand& from, void* to, GDALDataType type) {
    if (from.RasterIO(GF_Read, 0, 0, nx, ny, to, nx, ny, type, 0, 0, nullptr) != CE_None)
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

/// Values that no file means as a height, although it does not say so.
bool is_unspoken_nodata(double v, RasterQuantity quantity) {
  if (!(std::abs(v) < largest_value)) return true;
  if (v == -9999 || v == -99999 || v == -32768 || v == -32767) return true;
  return quantity == RasterQuantity::elevation && v < deepest_elevation_m;
}

void blank_unspoken_nodata(RasterSource& source, RasterQuantity quantity) {
  std::size_t count = 0;
  double example = 0;
  for (double& v : source.values) {
    if (std::isnan(v) || !is_unspoken_nodata(v, quantity)) continue;
    if (count++ == 0) example = v;
    v = nan_d;
  }
  if (count > 0)
    source.notes.push_back(
        fmt::format("{}: {} cells hold {:g} or the like, which the file does not declare as "
                    "nodata; they are treated as nodata",
                    source.label, count, example));
}

/// Metres per unit of the band's values, 0 for a word that is not known.
double metres_per_unit(std::string unit) {
  std::transform(unit.begin(), unit.end(), unit.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const char* word : {"", "m", "metre", "metres", "meter", "meters"})
    if (unit == word) return 1;
  for (const char* word : {"ft", "foot", "feet", "international foot"})
    if (unit == word) return foot;
  for (const char* word : {"us survey foot", "us-ft", "ftus", "us_survey_foot", "us foot"})
    if (unit == word) return survey_foot;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  if (unit == "km") return 1000;
  return 0;
}

void apply_scale_and_unit(RasterSource& source, GDALRasterBand& band,
                          const OGRSpatialReference* own, RasterQuantity quantity) {
  const double scale = band.GetScale(), offset = band.GetOffset();
  const std::string word = band.GetUnitType();
  double metres = metres_per_unit(word);
  std::string unit = word;
  if (word.empty() && own != nullptr && own->IsVertical()) {
    const char* name = nullptr;
    metres = own->GetTargetLinearUnits("VERT_CS", &name);
    unit = name == nullptr ? "" : name;
  }
  if (metres == 0) {
    source.notes.push_back(
        fmt::format("{}: unit '{}' is not known; values are taken as metres", source.label, word));
    metres = 1;
  }
  if (metres != 1)
    source.notes.push_back(fmt::format("{}: values converted from {} to metres (x {:.9g})",
                                       source.label, unit, metres));
  else if (quantity == RasterQuantity::elevation && unit.empty() && own != nullptr &&
           own->IsProjected() && std::abs(own->GetLinearUnits() - 1) > 1e-9)
    source.notes.push_back(fmt::format(
        "{}: the map's unit is not the metre and the file names no unit of height; elevations are "
        "taken as metres",
        source.label));
  if (scale == 1 && offset == 0 && metres == 1) return;
  for (double& v : source.values) {
    v = (v * scale + offset) * metres;
    if (!(std::abs(v) < largest_value)) v = nan_d;  // a scale beyond all sense
  }
}

/// Makes rows run south and columns east, as everything else here expects.
void turn_north_up(RasterSource& source) {
  if (!source.is_axis_aligned()) return;
  auto& a = source.affine;
  const int nx = source.n_cols, ny = source.n_rows;
  auto row = [&](int r) { return source.values.begin() + static_cast<std::ptrdiff_t>(r) * nx; };
  if (a[5] > 0) {
    for (int top = 0, bottom = ny - 1; top < bottom; ++top, --bottom)
      std::swap_ranges(row(top), row(top) + nx, row(bottom));
    a[3] += ny * a[5];
    a[5] = -a[5];
    source.notes.push_back(source.label + ": stored south-up, turned north-up");
  }
  if (a[1] < 0) {
    for (int r = 0; r < ny; ++r) std::reverse(row(r), row(r) + nx);
    a[0] += nx * a[1];
    a[1] = -a[1];
    source.notes.push_back(source.label + ": stored east to west, turned west to east");
  }
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

RasterSource read_source(const RasterRequest& request, RasterQuantity quantity, bool crs_optional) {
  const GdalScope scope;
  const InputFile file = find_input(request.key, request.path, request.directory);
  const OpenDataset dataset = open_dataset(file.path, file.label, GDAL_OF_RASTER);
  RasterSource source;
  source.label = file.label;
  source.files = files_of(*dataset.dataset);
  GDALRasterBand& band = first_band(*dataset.dataset, source.label);
  source.n_cols = dataset->GetRasterXSize();
  source.n_rows = dataset->GetRasterYSize();
  source.max_cells = request.max_cells;
  require_raster_size(source.n_cols, source.n_rows, source.label, source.max_cells);
  read_placement(source, *dataset.dataset);
  const OGRSpatialReference* own = dataset->GetSpatialRef();
  const bool bare = crs_optional && request.crs.empty() && (own == nullptr || own->IsEmpty());
  if (!bare) {
    std::string note;
    source.crs = settle_crs(own,
                            {source.label, request.crs_key, request.crs, request.fallback_crs_key,
                             request.fallback_crs},
                            extent_of(source), note);
    if (!note.empty()) source.notes.push_back(note);
  }
  if (dataset->GetRasterCount() > 1)
    source.notes.push_back(
        fmt::format("{}: band 1 of {} is used", source.label, dataset->GetRasterCount()));
  read_values(source, band);
  blank_unspoken_nodata(source, quantity);
  apply_scale_and_unit(source, band, own, quantity);
  turn_north_up(source);
  return source;
}

}  // namespace sturz
