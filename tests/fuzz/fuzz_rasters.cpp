// SPDX-License-Identifier: Apache-2.0
// Any bytes as a raster file: elevation, or a thickness laid onto a terrain with and without a
// coordinate system; or SetupError. GeoTIFF and the grids with text and binary headers: sizes,
// geotransforms, nodata, scales and units of any value.
#include "engine/core/error.hpp"
#include "io/gdal/gdal_raster.hpp"
#include "io/site/thickness_raster.hpp"
#include "tests/fuzz/gdal_memory.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>

namespace {

using sturz::Grid;

/// Honest files of more cells only take long.
constexpr double most_cells = 5000;

const Grid& terrain(bool with_crs) {
  static const Grid bare{20, 16, 499950, 4600100, 10, ""};
  static const Grid placed = [] {
    Grid grid = bare;
    OGRSpatialReference crs;
    crs.importFromEPSG(32633);
    char* text = nullptr;
    crs.exportToWkt(&text);
    grid.crs_wkt = text;
    CPLFree(text);
    return grid;
  }();
  return with_crs ? placed : bare;
}

template <class Read>
void run(Read read) {
  try {
    read();
  } catch (const sturz::SetupError&) {
  }
}

void read_bed(const sturz::RasterRequest& request) {
  const auto bed = sturz::read_elevation(request).raster;
  if (bed.values.size() != bed.grid.n_cells() || !(bed.grid.cell_m > 0)) std::abort();
  for (const double x : {bed.grid.west_m, bed.grid.north_m, bed.grid.east_m(), bed.grid.south_m()})
    if (!std::isfinite(x)) std::abort();
  for (const double v : bed.values)
    if (std::isinf(v)) std::abort();
}

void read_release(const sturz::RasterRequest& request, const Grid& grid) {
  const auto release = sturz::read_thickness(request, grid);
  double volume = 0;
  for (const double v : release.thickness.values) {
    if (!(v >= 0)) std::abort();
    volume += v * grid.cell_m * grid.cell_m;
  }
  if (!(std::abs(volume - release.volume_m3) <= 1e-6 * release.volume_m3)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  sturz::fuzz::keep_only_drivers(
      {"GTiff", "AAIGrid", "GRASSASCIIGrid", "GSAG", "GSBG", "GS7BG", "MEM"});
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const sturz::fuzz::GdalFile file("/vsimem/in.tif", {reinterpret_cast<const char*>(data), size});
  sturz::RasterRequest request;
  request.path = "/vsimem/in.tif";
  request.fallback_crs = "EPSG:32633";
  request.max_cells = most_cells;
  // One use for each input, chosen by its bytes: opening a file costs milliseconds.
  switch (std::accumulate(data, data + size, 0U) % 5) {
    case 0:
      run([&] { read_bed(request); });
      break;
    case 1:
      request.cell_size_m = 7;
      run([&] { read_bed(request); });
      break;
    case 2:
      request.crs = "EPSG:32633";
      request.factor = -1;
      run([&] { read_release(request, terrain(true)); });
      break;
    case 3:
      run([&] { read_release(request, terrain(true)); });
      break;
    default:
      run([&] { read_release(request, terrain(false)); });
  }
  return 0;
}
