// SPDX-License-Identifier: Apache-2.0
#include "io/site/observed/observed_outline.hpp"

#include "engine/core/error.hpp"
#include "io/site/polygon_layer.hpp"
#include "io/site/stand_in_crs.hpp"

#include <fmt/core.h>

namespace sturz {
namespace {

PolygonRequest observed_request(const Scenario& scenario, const Grid& terrain) {
  PolygonRequest request;
  request.path = scenario.hazard.observed_polygon;
  request.key = "hazard.observed_polygon";
  request.directory = scenario.directory;
  request.crs_key.clear();  // no key of its own
  request.layer_key.clear();
  request.what = "observed outline";
  request.without_terrain = terrain.n_cols == 0;
  stand_in_with_terrain(request, scenario.terrain);
  return request;
}

}  // namespace

ObservedOutline read_observed_outline(const Scenario& scenario, const Grid& terrain) {
  const GdalScope scope;
  const PolygonRequest request = observed_request(scenario, terrain);
  PolygonLayer layer = open_polygon_layer(request);
  ObservedOutline outline;
  OGREnvelope extent;
  double area_m2 = 0;
  for (const PolygonFeature& feature : read_features(layer, request, terrain)) {
    OGREnvelope own;
    feature.polygons->getEnvelope(&own);
    extent.Merge(own);
    area_m2 += feature.polygons->get_Area();
    for (const OGRPolygon* polygon : *feature.polygons)
      for (const OGRLinearRing* ring : *polygon) outline.rings.push_back(points_of(*ring));
  }
  if (!request.without_terrain) {
    require(extent.MinX < terrain.east_m() && extent.MaxX > terrain.west_m &&
                extent.MinY < terrain.north_m && extent.MaxY > terrain.south_m(),
            fmt::format("{}: lies beyond the terrain ({}). Is its coordinate system right?",
                        layer.label, places_text(extent, terrain)));
    layer.notes.push_back(fmt::format("{}: area {:.6g} m2", layer.label, area_m2));
  }
  outline.notes = std::move(layer.notes);
  outline.warnings = std::move(layer.warnings);
  outline.identity = std::move(layer.identity);
  return outline;
}

}  // namespace sturz
