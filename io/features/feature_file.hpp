// SPDX-License-Identifier: Apache-2.0
/// Features with attributes as GeoPackage: QGIS, ogrinfo and geopandas open it.
#pragma once

#include "scenarios/layers/feature_table.hpp"

#include <filesystem>
#include <span>

namespace sturz {

/// One layer with the table's name, a column per attribute (null where not known) and the
/// geometries as they are. The file appears whole or not at all, and the same table gives the same
/// bytes: its time stamps are 1 January 2000. \throws IoError
void write_geopackage(const std::filesystem::path& file, const FeatureTable& table);
/// The same with a layer for each of them, one at least. \throws IoError
void write_geopackage(const std::filesystem::path& file, std::span<const FeatureTable> tables);

}  // namespace sturz
