// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/fill_values.hpp"

#include "engine/core/error.hpp"
#include "engine/terrain/raster.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr double largest_value = 1e15;

template <class T>
bool is_end_of(double v) {
  return v == static_cast<double>(std::numeric_limits<T>::max()) ||
         (std::numeric_limits<T>::is_signed &&
          v == static_cast<double>(std::numeric_limits<T>::min()));
}

bool is_mark(double v, GDALDataType type, bool scaled) {
  if (!(std::abs(v) < largest_value)) return true;
  if (type == GDT_Int16 && is_end_of<std::int16_t>(v)) return true;
  if (type == GDT_UInt16 && is_end_of<std::uint16_t>(v)) return true;
  if (type == GDT_Int32 && is_end_of<std::int32_t>(v)) return true;
  if (type == GDT_UInt32 && is_end_of<std::uint32_t>(v)) return true;
  // With a scale these may be ground: -9999 cm lies 100 m below the sea.
  if (scaled) return false;
  return v == -9999 || v == -99999 || v == -32768 || v == -32767 || v == 32767 || v == 65535;
}

}  // namespace

void blank_marks(RasterSource& source, GDALDataType type, bool scaled) {
  std::size_t count = 0;
  double example = 0;
  for (double& v : source.values) {
    if (std::isnan(v) || !is_mark(v, type, scaled)) continue;
    if (count++ == 0) example = v;
    v = nan_d;
  }
  if (count > 0)
    source.notes.push_back(
        fmt::format("{}: {} cells hold {:g} or the like, which the file does not declare as "
                    "nodata; they are treated as nodata",
                    source.label, count, example));
}

void blank_beyond_earth(RasterSource& source) {
  std::size_t valid = 0, beyond = 0, first = 0;
  double lowest = INFINITY, highest = -INFINITY;
  for (std::size_t i = 0; i < source.values.size(); ++i) {
    const double v = source.values[i];
    if (std::isnan(v)) continue;
    ++valid;
    if (v >= lowest_ground_m && v <= highest_ground_m) continue;
    if (beyond++ == 0) first = i;
    lowest = std::min(lowest, v);
    highest = std::max(highest, v);
  }
  if (beyond == 0) return;
  require(beyond < valid,
          fmt::format("{}: its values reach from {:.6g} to {:.6g} m (no ground lies above {:g} or "
                      "below {:g} m). If they are centimetres or feet, say so in the file "
                      "(gdal_edit.py -scale or -units), or name a height system in terrain.crs.",
                      source.label, lowest, highest, highest_ground_m, lowest_ground_m));
  for (double& v : source.values)
    if (v < lowest_ground_m || v > highest_ground_m) v = nan_d;
  const auto n = static_cast<std::size_t>(source.n_cols);
  source.notes.push_back(fmt::format(
      "{}: {} cells hold {:.6g} to {:.6g} m, the first at row {}, column {} of the file; no ground "
      "lies above {:g} or below {:g} m, they are treated as nodata",
      source.label, beyond, lowest, highest, first / n + static_cast<std::size_t>(source.row0),
      first % n + static_cast<std::size_t>(source.col0), highest_ground_m, lowest_ground_m));
}

}  // namespace sturz
