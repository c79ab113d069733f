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

constexpr const char* value_field = "value";

int CPL_STDCALL go_on(double, const char*, void* cancel) {
  return static_cast<const CancelFlag*>(cancel)->raised() ? FALSE : TRUE;
}

/// Polygons of equal cells, those of 0 left out by the mask.
DatasetPtr polygons_of(const Raster<std::uint8_t>& cells, CancelFlag cancel) {
  const auto affine = affine_of(cells.grid);
  // The library takes memory that it could write to, and only reads it here.
  auto* memory = const_cast<std::uint8_t*>(cells.values.data());
  const DatasetPtr raster =
      wrap_in_memory(memory, GDT_Byte, cells.grid.n_cols, cells.grid.n_rows, affine.data());
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("Memory");
  if (raster == nullptr || driver == nullptr) fail();
  DatasetPtr out(driver->Create("", 0, 0, 0, GDT_Unknown, nullptr));
  OGRLayer* layer =
      out == nullptr ? nullptr : out->CreateLayer("cells", nullptr, wkbPolygon, nullptr);
  OGRFieldDefn field(value_field, OFTInteger);
  if (layer == nullptr || layer->CreateField(&field) != OGRERR_NONE) fail();
  GDALRasterBand* band = raster->GetRasterBand(1);
  if (GDALPolygonize(GDALRasterBand::ToHandle(band), GDALRasterBand::ToHandle(band),
                     OGRLayer::ToHandle(layer), 0, nullptr, go_on, &cancel) != CE_None) {
    cancel.check();
    fail();
  }
  return out;
}

std::string wkb_of(const OGRGeometry& geometry) {
  std::vector<unsigned char> wkb(geometry.WkbSize());
  if (geometry.exportToWkb(wkbNDR, wkb.data(), wkbVariantIso) != OGRERR_NONE) fail();
  return {wkb.begin(), wkb.end()};
}

}  // namespace

std::string cells_as_polygons(const Raster<std::uint8_t>& cells) {
  Raster<std::uint8_t> set = cells;  // any value but 0 is the same area
  for (std::uint8_t& cell : set.values) cell = cell == 0 ? 0 : 1;
  const auto found = classes_as_polygons(set);
  return found.empty() ? std::string() : found.begin()->second;
}

std::map<std::uint8_t, std::string> classes_as_polygons(const Raster<std::uint8_t>& cells,
                                                        CancelFlag cancel) {
  std::map<std::uint8_t, std::string> found;
  if (std::all_of(cells.values.begin(), cells.values.end(), [](auto c) { return c == 0; }))
    return found;
  const GdalScope scope;
  std::map<std::uint8_t, OGRMultiPolygon> all;
  const DatasetPtr polygons = polygons_of(cells, cancel);
  for (const auto& feature : polygons->GetLayer(0)) {
    const auto value = static_cast<std::uint8_t>(feature->GetFieldAsInteger(0));
    if (all[value].addGeometryDirectly(feature->StealGeometry()) != OGRERR_NONE) fail();
  }
  for (const auto& [value, area] : all) found[value] = wkb_of(area);
  return found;
}

}  // namespace sturz
