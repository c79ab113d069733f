// SPDX-License-Identifier: Apache-2.0
#include "io/features/cell_polygons.hpp"

#include "io/files/io_error.hpp"
#include "io/gdal/gdal_handles.hpp"

#include <fmt/core.h>
#include <gdal_alg.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sturz {
namespace {

[[noreturn]] void fail() {
  throw IoError(fmt::format("the outline of a map cannot be made ({}).", gdal_reason()));
}

/// Polygons of equal cells, those of cells that are not set left out by the mask.
DatasetPtr polygons_of(Raster<std::uint8_t> cells) {
  const auto affine = affine_of(cells.grid);
  const DatasetPtr raster = wrap_in_memory(cells.values.data(), GDT_Byte, cells.grid.n_cols,
                                           cells.grid.n_rows, affine.data());
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("Memory");
  if (raster == nullptr || driver == nullptr) fail();
  DatasetPtr out(driver->Create("", 0, 0, 0, GDT_Unknown, nullptr));
  OGRLayer* layer =
      out == nullptr ? nullptr : out->CreateLayer("cells", nullptr, wkbPolygon, nullptr);
  if (layer == nullptr) fail();
  GDALRasterBand* band = raster->GetRasterBand(1);
  if (GDALPolygonize(GDALRasterBand::ToHandle(band), GDALRasterBand::ToHandle(band),
                     OGRLayer::ToHandle(layer), -1, nullptr, nullptr, nullptr) != CE_None)
    fail();
  return out;
}

}  // namespace

std::string cells_as_polygons(const Raster<std::uint8_t>& cells) {
  if (std::all_of(cells.values.begin(), cells.values.end(), [](auto c) { return c == 0; }))
    return {};
  const GdalScope scope;
  Raster<std::uint8_t> set = cells;  // any value but 0 is the same area
  for (std::uint8_t& cell : set.values) cell = cell == 0 ? 0 : 1;
  const DatasetPtr found = polygons_of(std::move(set));
  OGRMultiPolygon all;
  for (const auto& feature : found->GetLayer(0))
    if (all.addGeometry(feature->GetGeometryRef()) != OGRERR_NONE) fail();
  std::vector<unsigned char> wkb(all.WkbSize());
  if (all.exportToWkb(wkbNDR, wkb.data(), wkbVariantIso) != OGRERR_NONE) fail();
  return {wkb.begin(), wkb.end()};
}

}  // namespace sturz
