// SPDX-License-Identifier: Apache-2.0
#include "io/features/feature_file.hpp"

#include "io/files/atomic_file.hpp"
#include "io/files/io_error.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <fmt/core.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace sturz {
namespace {

using MemoryBytes = std::unique_ptr<GByte, decltype(&VSIFree)>;

/// GDAL writes the time of writing unless this says another one, in this thread only.
class FixedDate {
 public:
  FixedDate() { CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", "2000-01-01T00:00:00.000Z"); }
  ~FixedDate() { CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", nullptr); }
  FixedDate(const FixedDate&) = delete;
  FixedDate& operator=(const FixedDate&) = delete;
};

/// The file while it is made, in the library's memory.
class InMemory {
 public:
  explicit InMemory(const void* owner) : name_(fmt::format("/vsimem/sturz_{}.gpkg", owner)) {}
  ~InMemory() { VSIUnlink(name_.c_str()); }
  InMemory(const InMemory&) = delete;
  InMemory& operator=(const InMemory&) = delete;
  const char* name() const { return name_.c_str(); }

 private:
  std::string name_;
};

[[noreturn]] void fail(const std::filesystem::path& file) {
  throw IoError(fmt::format("{}: cannot be made ({}).", file.string(), gdal_reason()));
}

OGRFieldType type_of(const FeatureColumn& column) {
  switch (column.values.index()) {
    case 0:
      return OFTString;
    case 1:
      return OFTInteger64;
    default:
      return OFTReal;
  }
}

void set(OGRFeature& feature, int field, const std::string& value) {
  feature.SetField(field, value.c_str());
}
void set(OGRFeature& feature, int field, std::int64_t value) {
  feature.SetField(field, static_cast<GIntBig>(value));
}
void set(OGRFeature& feature, int field, double value) {
  if (std::isnan(value))
    feature.SetFieldNull(field);
  else
    feature.SetField(field, value);
}

bool add_row(OGRLayer& layer, const FeatureTable& table, std::size_t row) {
  const OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(layer.GetLayerDefn()));
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    std::visit([&](const auto& values) { set(*feature, static_cast<int>(k), values[row]); },
               table.columns[k].values);
  OGRGeometry* geometry = nullptr;
  const std::string& wkb = table.wkb[row];
  if (OGRGeometryFactory::createFromWkb(wkb.data(), nullptr, &geometry, wkb.size(),
                                        wkbVariantIso) != OGRERR_NONE)
    return false;
  feature->SetGeometryDirectly(geometry);
  return layer.CreateFeature(feature.get()) == OGRERR_NONE;
}

/// Metres that lie nowhere on the earth would be taken for degrees without a system.
OGRSpatialReference system_of(const FeatureTable& table) {
  OGRSpatialReference system = crs_from_wkt(table.crs_wkt);
  if (!table.crs_wkt.empty()) return system;
  system.SetLocalCS("local coordinates in metres");
  system.SetLinearUnits(SRS_UL_METER, 1);
  return system;
}

bool write_table(GDALDataset& dataset, const FeatureTable& table) {
  OGRSpatialReference system = system_of(table);
  OGRLayer* layer = dataset.CreateLayer(table.name.c_str(), &system, wkbUnknown, nullptr);
  if (layer == nullptr || dataset.StartTransaction() != OGRERR_NONE) return false;
  for (const FeatureColumn& column : table.columns) {
    OGRFieldDefn field(column.name.c_str(), type_of(column));
    if (layer->CreateField(&field) != OGRERR_NONE) return false;
  }
  for (std::size_t row = 0; row < table.size(); ++row)
    if (!add_row(*layer, table, row)) return false;
  return dataset.CommitTransaction() == OGRERR_NONE;
}

}  // namespace

void write_geopackage(const std::filesystem::path& file, const FeatureTable& table) {
  write_geopackage(file, std::span(&table, 1));
}

void write_geopackage(const std::filesystem::path& file, std::span<const FeatureTable> tables) {
  const GdalScope scope;
  const FixedDate date;
  const InMemory memory(tables.data());
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  if (driver == nullptr)
    throw IoError(fmt::format("{}: this build of GDAL cannot write GeoPackage.", file.string()));
  {
    const DatasetPtr dataset(driver->Create(memory.name(), 0, 0, 0, GDT_Unknown, nullptr));
    if (dataset == nullptr) fail(file);
    for (const FeatureTable& table : tables)
      if (!write_table(*dataset, table)) fail(file);
  }
  vsi_l_offset size = 0;
  const MemoryBytes bytes(VSIGetMemFileBuffer(memory.name(), &size, true), &VSIFree);
  if (bytes == nullptr || size == 0) fail(file);
  write_bytes_atomic(file, std::as_bytes(std::span(bytes.get(), static_cast<std::size_t>(size))));
}

}  // namespace sturz
