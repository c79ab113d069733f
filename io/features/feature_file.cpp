// SPDX-License-Identifier: Apache-2.0
#include "io/features/feature_file.hpp"

#include "io/files/atomic_file.hpp"
#include "io/files/io_error.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/core.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

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

/// How a layer looks in QGIS, by the layer's name.
struct NamedStyle {
  std::string layer, qml;
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

using GeometryPtr = std::unique_ptr<OGRGeometry>;

/// nullptr for bytes that are none.
GeometryPtr geometry_of(const std::string& wkb) {
  OGRGeometry* geometry = nullptr;
  const OGRErr code =
      OGRGeometryFactory::createFromWkb(wkb.data(), nullptr, &geometry, wkb.size(), wkbVariantIso);
  return GeometryPtr(code == OGRERR_NONE ? geometry : nullptr);
}

/// One type, or polygons and multi-polygons: readers draw layers of one type only.
OGRwkbGeometryType type_of(const FeatureTable& table) {
  std::set<OGRwkbGeometryType> types;
  for (const std::string& wkb : table.wkb)
    if (const GeometryPtr geometry = geometry_of(wkb)) types.insert(geometry->getGeometryType());
  if (types.size() == 1) return *types.begin();
  return types == std::set{wkbPolygon, wkbMultiPolygon} ? wkbMultiPolygon : wkbUnknown;
}

bool add_row(OGRLayer& layer, const FeatureTable& table, std::size_t row) {
  const OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(layer.GetLayerDefn()));
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    std::visit([&](const auto& values) { set(*feature, static_cast<int>(k), values[row]); },
               table.columns[k].values);
  GeometryPtr geometry = geometry_of(table.wkb[row]);
  if (geometry == nullptr) return false;
  OGRGeometry* shape = geometry.release();
  if (layer.GetGeomType() == wkbMultiPolygon)
    shape = OGRGeometryFactory::forceToMultiPolygon(shape);
  feature->SetGeometryDirectly(shape);
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
  // The index of a few features is longer than they are.
  constexpr std::size_t worth_an_index = 1000;
  CPLStringList options;
  options.SetNameValue("SPATIAL_INDEX", table.size() < worth_an_index ? "NO" : "YES");
  OGRLayer* layer =
      dataset.CreateLayer(table.name.c_str(), &system, type_of(table), options.List());
  if (layer == nullptr || dataset.StartTransaction() != OGRERR_NONE) return false;
  for (const FeatureColumn& column : table.columns) {
    OGRFieldDefn field(column.name.c_str(), type_of(column));
    if (layer->CreateField(&field) != OGRERR_NONE) return false;
  }
  for (std::size_t row = 0; row < table.size(); ++row)
    if (!add_row(*layer, table, row)) return false;
  return dataset.CommitTransaction() == OGRERR_NONE;
}

/// The table in which QGIS looks for styles, with its columns as QGIS makes them.
bool write_styles(GDALDataset& dataset, const std::vector<NamedStyle>& styles) {
  if (styles.empty()) return true;
  CPLStringList options;
  options.SetNameValue("FID", "id");
  OGRLayer* layer = dataset.CreateLayer("layer_styles", nullptr, wkbNone, options.List());
  if (layer == nullptr || dataset.StartTransaction() != OGRERR_NONE) return false;
  for (const char* name : {"f_table_catalog", "f_table_schema", "f_table_name", "f_geometry_column",
                           "styleName", "styleQML", "styleSLD", "description", "owner", "ui"}) {
    OGRFieldDefn field(name, OFTString);
    if (layer->CreateField(&field) != OGRERR_NONE) return false;
  }
  OGRFieldDefn by_default("useAsDefault", OFTInteger), time("update_time", OFTDateTime);
  by_default.SetSubType(OFSTBoolean);
  if (layer->CreateField(&by_default) != OGRERR_NONE || layer->CreateField(&time) != OGRERR_NONE)
    return false;
  for (const NamedStyle& style : styles) {
    const OGRFeatureUniquePtr row(OGRFeature::CreateFeature(layer->GetLayerDefn()));
    for (const char* empty : {"f_table_catalog", "f_table_schema", "styleSLD", "owner", "ui"})
      row->SetField(empty, "");
    OGRLayer* styled = dataset.GetLayerByName(style.layer.c_str());
    if (styled == nullptr) return false;
    row->SetField("f_table_name", style.layer.c_str());
    row->SetField("f_geometry_column", styled->GetGeometryColumn());
    row->SetField("styleName", style.layer.c_str());
    row->SetField("styleQML", style.qml.c_str());
    row->SetField("description", "classes and colours of the report");
    row->SetField("useAsDefault", 1);
    row->SetField(row->GetFieldIndex("update_time"), 2000, 1, 1, 0, 0, 0.0F, 100);
    if (layer->CreateFeature(row.get()) != OGRERR_NONE) return false;
  }
  return dataset.CommitTransaction() == OGRERR_NONE;
}

}  // namespace

class GeoPackage::Parts {
 public:
  explicit Parts(std::filesystem::path file) : file_(std::move(file)), memory_(this) {
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
    if (driver == nullptr)
      throw IoError(fmt::format("{}: this build of GDAL cannot write GeoPackage.", file_.string()));
    dataset_.reset(driver->Create(memory_.name(), 0, 0, 0, GDT_Unknown, nullptr));
    if (dataset_ == nullptr) fail(file_);
  }

  void add(const FeatureTable& table, const std::string& style) {
    if (!write_table(*dataset_, table)) fail(file_);
    if (!style.empty()) styles_.push_back({table.name, style});
  }

  void commit() {
    if (!write_styles(*dataset_, styles_)) fail(file_);
    dataset_.reset();
    vsi_l_offset size = 0;
    const MemoryBytes bytes(VSIGetMemFileBuffer(memory_.name(), &size, true), &VSIFree);
    if (bytes == nullptr || size == 0) fail(file_);
    write_bytes_atomic(file_,
                       std::as_bytes(std::span(bytes.get(), static_cast<std::size_t>(size))));
  }

 private:
  const GdalScope scope_;
  const FixedDate date_;
  std::filesystem::path file_;
  InMemory memory_;
  DatasetPtr dataset_;
  std::vector<NamedStyle> styles_;
};

GeoPackage::GeoPackage(std::filesystem::path file)
    : parts_(std::make_unique<Parts>(std::move(file))) {}
GeoPackage::~GeoPackage() = default;
void GeoPackage::add(const FeatureTable& table, const std::string& style) {
  parts_->add(table, style);
}
void GeoPackage::commit() { parts_->commit(); }

void write_geopackage(const std::filesystem::path& file, const FeatureTable& table) {
  write_geopackage(file, std::span(&table, 1));
}

void write_geopackage(const std::filesystem::path& file, std::span<const FeatureTable> tables) {
  GeoPackage package(file);
  for (const FeatureTable& table : tables) package.add(table);
  package.commit();
}

}  // namespace sturz
