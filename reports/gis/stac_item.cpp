// SPDX-License-Identifier: Apache-2.0
#include "reports/gis/stac_item.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace sturz {
namespace {

using Json = nlohmann::ordered_json;

Json place_of(const StacItem& item) {
  if (item.outline.empty()) return nullptr;
  Json ring = Json::array();
  for (const Vec2& corner : item.outline) ring.push_back({corner.x(), corner.y()});
  return {{"type", "Polygon"}, {"coordinates", Json::array({ring})}};
}

/// West, south, east, north.
Json box_of(const std::vector<Vec2>& outline) {
  Vec2 low = outline.front(), high = low;
  for (const Vec2& corner : outline) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
  return {low.x(), low.y(), high.x(), high.y()};
}

Json properties_of(const StacItem& item) {
  const Grid& g = item.grid;
  Json properties = {{"title", item.title},
                     {"description", item.description},
                     {"datetime", item.datetime},
                     {"processing:software", {{"sturz", item.software}}},
                     {"proj:epsg", nullptr},
                     {"proj:bbox", {g.west_m, g.south_m(), g.east_m(), g.north_m}},
                     {"proj:shape", {g.n_rows, g.n_cols}},
                     {"proj:transform", {g.cell_m, 0, g.west_m, 0, -g.cell_m, g.north_m, 0, 0, 1}}};
  if (item.epsg) properties["proj:epsg"] = *item.epsg;
  if (!g.crs_wkt.empty()) properties["proj:wkt2"] = g.crs_wkt;
  return properties;
}

Json asset_of(const StacAsset& asset) {
  Json one = {{"href", "./" + asset.href},
              {"title", asset.title},
              {"type", asset.type},
              {"roles", asset.roles}};
  if (asset.on_grid)
    one["raster:bands"] =
        Json::array({{{"data_type", "float32"}, {"nodata", "nan"}, {"unit", asset.unit}}});
  return one;
}

}  // namespace

std::string stac_item(const StacItem& item) {
  Json assets = Json::object();
  for (const StacAsset& asset : item.assets) assets[asset.key] = asset_of(asset);
  Json all = {{"type", "Feature"},
              {"stac_version", "1.0.0"},
              {"stac_extensions",
               {"https://stac-extensions.github.io/projection/v1.1.0/schema.json",
                "https://stac-extensions.github.io/raster/v1.1.0/schema.json",
                "https://stac-extensions.github.io/processing/v1.1.0/schema.json"}},
              {"id", item.id},
              {"geometry", place_of(item)}};
  // The specification wants a box with a geometry, and none without.
  if (!item.outline.empty()) all["bbox"] = box_of(item.outline);
  all["properties"] = properties_of(item);
  all["links"] = Json::array();
  all["assets"] = std::move(assets);
  return all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sturz
