// SPDX-License-Identifier: Apache-2.0
#include "engine/core/error.hpp"
#include "io/site/polygon_cells.hpp"
#include "io/site/polygon_layer.hpp"
#include "io/site/stand_in_crs.hpp"
#include "io/site/structures/structure_inputs.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>

namespace sturz {
namespace {

PolygonRequest request_of(const Scenario& scenario) {
  const BuildingsSpec& spec = *scenario.terrain.buildings;
  PolygonRequest request;
  request.path = spec.polygon;
  request.layer = spec.layer;
  request.key = "terrain.buildings.polygon";
  request.directory = scenario.directory;
  request.crs_key.clear();  // no key of its own
  stand_in_with_terrain(request, scenario.terrain);
  request.layer_key = "terrain.buildings.layer";
  request.what = "building";
  return request;
}

/// Heights go where a release has its thickness.
std::vector<PolygonFeature> features_of(PolygonLayer& layer, const PolygonRequest& request,
                                        const BuildingsSpec& spec, const Grid& terrain) {
  const std::string& name = spec.height_attribute;
  const int field = name.empty() ? -1 : layer.layer->GetLayerDefn()->GetFieldIndex(name.c_str());
  require(name.empty() || field >= 0,
          fmt::format("{}: has no field '{}' (terrain.buildings.height_attribute).", layer.label,
                      name));
  return read_features(layer, request, terrain, [&](OGRFeature& read, PolygonFeature& feature) {
    feature.thickness_m = spec.height_m;
    if (field < 0) return;
    require(read.IsFieldSetAndNotNull(field) != 0,
            fmt::format("{}: {} has no height in field '{}'. Fill it in or remove "
                        "terrain.buildings.height_attribute.",
                        layer.label, feature.name, name));
    feature.thickness_m = read.GetFieldAsDouble(field);
    require(feature.thickness_m > 0 && feature.thickness_m <= 1000,
            fmt::format("{}: height of {} is {:g} (must be > 0 and <= 1000 m).", layer.label,
                        feature.name, feature.thickness_m));
  });
}

}  // namespace

BuildingsRead read_buildings(const Scenario& scenario, const Grid& terrain, const Window& held) {
  const GdalScope scope;
  const BuildingsSpec& spec = *scenario.terrain.buildings;
  const PolygonRequest request = request_of(scenario);
  PolygonLayer layer = open_polygon_layer(request);
  BuildingsRead out;
  std::map<std::size_t, RaisedCell> raised;  // the highest of those that overlap
  std::size_t on_terrain = 0;
  int lost = 0;
  for (const PolygonFeature& feature : features_of(layer, request, spec, terrain)) {
    std::size_t count = 0;
    for (const OGRPolygon* polygon : *feature.polygons) {
      PolygonCells cells(terrain, held);
      for (const OGRLinearRing* ring : *polygon) cells.add_ring(points_of(*ring));
      for (const std::size_t cell : cells.finish()) {
        RaisedCell& at = raised[cell];
        if (feature.thickness_m <= at.by_m) continue;
        at = {cell, feature.thickness_m, out.n_buildings};
      }
      count += cells.count();
    }
    on_terrain += count;
    lost += count == 0;
    ++out.n_buildings;
  }
  require(
      on_terrain > 0,
      fmt::format("{}: no building holds the centre of a cell of the terrain (cells of {:g} m). "
                  "Is its coordinate system right?",
                  layer.label, terrain.cell_m));
  for (const auto& [cell, at] : raised) out.cells.push_back(at);
  out.notes = std::move(layer.notes);
  out.warnings = std::move(layer.warnings);
  out.identity = std::move(layer.identity);
  double highest = 0;
  for (const RaisedCell& cell : out.cells) highest = std::max(highest, cell.by_m);
  out.notes.push_back(fmt::format("{}: {} buildings on {} cells of {:g} m, up to {:g} m high",
                                  layer.label, out.n_buildings - lost, on_terrain, terrain.cell_m,
                                  highest));
  if (lost > 0)
    out.warnings.push_back(
        fmt::format("{}: {} of {} buildings hold the centre of no cell of {:g} m (too small, or "
                    "beyond the terrain) and are not there",
                    layer.label, lost, out.n_buildings, terrain.cell_m));
  return out;
}

void check_buildings(const Scenario& scenario) {
  const GdalScope scope;
  PolygonRequest request = request_of(scenario);
  request.without_terrain = true;
  PolygonLayer layer = open_polygon_layer(request);
  features_of(layer, request, *scenario.terrain.buildings, {});
}

}  // namespace sturz
