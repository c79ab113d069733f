// SPDX-License-Identifier: Apache-2.0
/// Features with attributes as GeoPackage: QGIS, ogrinfo and geopandas open it.
#pragma once

#include "scenarios/layers/feature_table.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace sturz {

/// A file of several layers that takes one table after the other, so that its maker need not hold
/// them all. Each layer has the table's name, a column per attribute (null where not known), and
/// the type of its geometries where they have one type (polygons beside multi-polygons become
/// such). The file appears whole or not at all, and the same tables give the same bytes: time
/// stamps are 1 January 2000. While it lives, the thread makes no other file of this kind.
class GeoPackage {
 public:
  /// \throws IoError where this build of the library cannot write them
  explicit GeoPackage(std::filesystem::path file);
  ~GeoPackage();
  GeoPackage(const GeoPackage&) = delete;
  GeoPackage& operator=(const GeoPackage&) = delete;

  /// \param style text of a .qml, which QGIS takes by itself (table layer_styles); empty: none
  /// \throws IoError
  void add(const FeatureTable& table, const std::string& style = {});
  /// Gives the file its name. \throws IoError
  void commit();

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

/// A file of one layer. \throws IoError
void write_geopackage(const std::filesystem::path& file, const FeatureTable& table);
/// The same with a layer for each of them, one at least. \throws IoError
void write_geopackage(const std::filesystem::path& file, std::span<const FeatureTable> tables);

}  // namespace sturz
