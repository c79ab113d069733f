// SPDX-License-Identifier: Apache-2.0
/// Results as an item of a SpatioTemporal Asset Catalog, for data catalogues and their clients.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sturz {

/// One file of an item.
struct StacAsset {
  std::string key;    ///< unique, e.g. the file's name
  std::string href;   ///< from the folder of the item
  std::string title;  ///< in words
  std::string type;   ///< media type
  std::vector<std::string> roles;
  std::string unit;      ///< of a raster's values, UDUNITS text; empty: no raster
  bool on_grid = false;  ///< a raster on the item's grid
};

struct StacItem {
  std::string id, title, description;
  std::string datetime;       ///< UTC, ISO 8601: when the results were computed
  std::string software;       ///< program and version
  Grid grid;                  ///< of the maps
  std::optional<int> epsg;    ///< of their system
  std::vector<Vec2> outline;  ///< closed ring, longitude and latitude; empty: no place on earth
  std::vector<StacAsset> assets;
};

/// GeoJSON of the item: STAC 1.0.0 with the extensions projection 1.1.0 (proj:epsg, proj:wkt2,
/// proj:bbox, proj:shape, proj:transform) and raster 1.1.0 (unit and nodata of bands).
std::string stac_item(const StacItem& item);

}  // namespace sturz
