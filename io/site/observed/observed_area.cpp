// SPDX-License-Identifier: Apache-2.0
#include "engine/core/error.hpp"
#include "io/gdal/ogr_polygons.hpp"
#include "io/site/observed/observed_files.hpp"
#include "io/site/polygon_cover.hpp"
#include "io/site/polygon_layer.hpp"

#include <fmt/core.h>

#include <utility>

namespace sturz {
namespace {

/// Parts below this share are round-off, not beyond the edge.
constexpr double area_round_off = 1e-9;

std::vector<std::vector<Vec2>> rings_of(const OGRMultiPolygon& polygons, bool holes) {
  std::vector<std::vector<Vec2>> rings;
  for (const OGRPolygon* polygon : polygons) {
    if (!holes) {
      rings.push_back(points_of(*polygon->getExteriorRing()));
      continue;
    }
    for (const OGRLinearRing* ring : *polygon) rings.push_back(points_of(*ring));
  }
  return rings;
}

/// What lies on the maps; the rest is warned of.
PolygonsPtr on_maps(PolygonsPtr polygons, const Grid& maps, PolygonLayer& layer) {
  const OGRPolygon edge = rectangle(maps, 0);
  const double all = polygons->get_Area(), beyond = area_outside(*polygons, edge);
  if (beyond <= area_round_off * all) return polygons;
  OGREnvelope extent;
  polygons->getEnvelope(&extent);
  require(beyond < (1 - area_round_off) * all,
          fmt::format("{}: lies beyond the terrain ({}). Is its coordinate system right?",
                      layer.label, places_text(extent, maps)));
  layer.warnings.push_back(
      fmt::format("{}: {:.6g} of {:.6g} m2 lie beyond the terrain and are not compared; a larger "
                  "terrain would hold them",
                  layer.label, beyond, all));
  const std::unique_ptr<OGRGeometry> inside(polygons->Intersection(&edge));
  require(inside != nullptr, layer.label + ": cannot be cut at the terrain's edge.");
  std::string ignored;
  return polygons_in(*inside, ignored);
}

}  // namespace

AreaRead read_observed_area(const PolygonRequest& request, const Grid& maps) {
  PolygonLayer layer = open_polygon_layer(request);
  const std::vector<PolygonFeature> features = read_features(layer, request, maps);
  AreaRead read;
  std::vector<const OGRMultiPolygon*> all;
  for (const PolygonFeature& feature : features) all.push_back(feature.polygons.get());
  if (!request.without_terrain) {
    PolygonsPtr polygons = united(all, layer.label);
    read.rings = rings_of(*polygons, true);
    polygons = on_maps(std::move(polygons), maps, layer);
    OGREnvelope extent;
    polygons->getEnvelope(&extent);
    PolygonCover cover(maps, cells_under(extent.MinX, extent.MaxX, extent.MinY, extent.MaxY, maps));
    const double area_m2 = lay_down(*polygons, 1, cover);
    read.area.cover = cover.finish();
    read.area.outer = rings_of(*polygons, false);
    layer.notes.push_back(fmt::format("{}: area {:.6g} m2", layer.label, area_m2));
  }
  read.notes = std::move(layer.notes);
  read.warnings = std::move(layer.warnings);
  read.identity = std::move(layer.identity);
  return read;
}

}  // namespace sturz
