// SPDX-License-Identifier: Apache-2.0
// Any bytes as a vector file (GeoJSON, GeoPackage, shapefile): a release, the cells of a zone, or
// SetupError. A shapefile's three files stand in a row, with <<shx>> and <<dbf>> between them.
#include "engine/core/error.hpp"
#include "io/gdal/gdal_vector.hpp"
#include "io/site/zone_cells.hpp"
#include "tests/fuzz/gdal_memory.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <string_view>

namespace {

using sturz::Grid;
using sturz::fuzz::GdalFile;

template <class Read>
void run(Read read) {
  try {
    read();
  } catch (const sturz::SetupError&) {
  }
}

void read_release(const sturz::PolygonRequest& request, const Grid& grid) {
  const auto release = sturz::read_release_polygons(request, grid);
  const Grid& own = release.pattern.grid;  // cells of the terrain's grid around the polygons
  if (own.n_cells() > grid.n_cells() || release.pattern.values.size() != own.n_cells())
    std::abort();
  for (const double v : release.pattern.values)
    if (!(v >= 0) || std::isinf(v)) std::abort();
}

void read_zone(const sturz::PolygonRequest& request, const Grid& grid) {
  for (const std::size_t cell : sturz::read_zone_cells(request, grid).cells)
    if (cell >= grid.n_cells()) std::abort();
}

void read_one(const std::string& path, unsigned use) {
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
  sturz::PolygonRequest request;
  request.path = path;
  switch (use % 4) {  // one for each input, chosen by its bytes
    case 0:
      return run([&] { read_zone(request, bare); });
    case 1:
      return run([&] { read_zone(request, placed); });
    case 2:
      return run([&] { read_release(request, placed); });
    default:
      request.thickness_attribute = "h";
      request.crs = "EPSG:32633";
      run([&] { read_release(request, placed); });
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  sturz::fuzz::keep_only_drivers({"GeoJSON", "GPKG", "ESRI Shapefile", "Memory", "MEM"});
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const unsigned use = std::accumulate(data, data + size, 0U);
  constexpr std::string_view index_mark = "<<shx>>", table_mark = "<<dbf>>",
                             shape_magic("\0\0\x27\x0a", 4);
  if (!bytes.starts_with(shape_magic)) {
    const char* path = bytes.starts_with("SQLite") ? "/vsimem/in.gpkg" : "/vsimem/in.geojson";
    const GdalFile file(path, bytes);
    read_one(path, use);
    return 0;
  }
  const std::size_t index = std::min(bytes.find(index_mark), size);
  const std::size_t table = std::min(bytes.find(table_mark, index), size);
  const auto part = [&](std::size_t mark, std::size_t end) {
    return mark < end ? bytes.substr(mark + index_mark.size(), end - mark - index_mark.size())
                      : std::string_view();
  };
  const GdalFile shapes("/vsimem/in.shp", bytes.substr(0, index));
  const GdalFile places("/vsimem/in.shx", part(index, table));
  const GdalFile attributes("/vsimem/in.dbf", part(table, size));
  read_one("/vsimem/in.shp", use);
  return 0;
}
