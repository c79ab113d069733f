// SPDX-License-Identifier: Apache-2.0
#include "io/site/overlays/overlay_layers.hpp"

#include "engine/core/error.hpp"
#include "io/files/plain_text.hpp"
#include "io/site/polygon_cover.hpp"
#include "io/site/polygon_layer.hpp"
#include "io/site/stand_in_crs.hpp"

#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <utility>

namespace sturz {
namespace {

using GeometryPtr = std::unique_ptr<OGRGeometry>;

/// Of one geometry; larger ones are shown, or refused, as they are.
constexpr std::size_t most_corners_to_thin = 10'000;

PolygonRequest request_of(const Scenario& scenario, const std::string& name,
                          const std::string& file, bool without_terrain) {
  PolygonRequest request;
  request.path = file;
  request.key = "report.overlays: " + name;
  request.layer_key = "";
  request.directory = scenario.directory;
  request.crs_key = "";
  request.what = "overlay";
  request.without_terrain = without_terrain;
  stand_in_with_terrain(request, scenario.terrain);
  return request;
}

std::vector<Vec2> corners(const OGRLineString& line) {
  std::vector<Vec2> points;
  for (const OGRPoint& p : line) points.emplace_back(p.getX(), p.getY());
  return points;
}

/// Parts of collections become features of their own; anything but points, lines and polygons is
/// left out.
void add_parts(const OGRGeometry& geometry, const std::string& name, Overlay& overlay) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection())
      add_parts(*part, name, overlay);
    return;
  }
  OverlayFeature feature;
  feature.name = name;
  if (type == wkbPoint) {
    feature.parts = {{{geometry.toPoint()->getX(), geometry.toPoint()->getY()}}};
  } else if (type == wkbLineString) {
    feature.kind = OverlayFeature::Kind::line;
    feature.parts = {corners(*geometry.toLineString())};
  } else if (type == wkbPolygon) {
    feature.kind = OverlayFeature::Kind::polygon;
    for (const OGRLinearRing* ring : *geometry.toPolygon()) feature.parts.push_back(corners(*ring));
  } else {
    return;
  }
  overlay.features.push_back(std::move(feature));
}

/// Within the terrain, without corners that no reader sees; null where nothing is left.
GeometryPtr shown_part(const OGRGeometry& own, const OGRPolygon& edge, double tolerance_m) {
  GeometryPtr flat(own.hasCurveGeometry() ? own.getLinearGeometry() : own.clone());
  flat->flattenTo2D();
  if (!flat->IsValid()) flat.reset(flat->MakeValid());
  if (!flat || !flat->Intersects(&edge)) return nullptr;
  GeometryPtr inside(flat->Intersection(&edge));
  if (!inside || inside->IsEmpty()) return nullptr;
  // Thinning takes stack and the square of the time with the corners of one geometry.
  if (inside->WkbSize() / sizeof(Vec2) > most_corners_to_thin) return inside;
  GeometryPtr thin(inside->SimplifyPreserveTopology(tolerance_m));
  return thin && !thin->IsEmpty() ? std::move(thin) : std::move(inside);
}

std::string name_of(OGRFeature& feature) {
  // In any case of letters; a layer may have several.
  for (int field = 0; field < feature.GetFieldCount(); ++field)
    if (EQUAL(feature.GetFieldDefnRef(field)->GetNameRef(), "name") &&
        feature.IsFieldSetAndNotNull(field))
      return as_utf8(feature.GetFieldAsString(field));
  return {};
}

Overlay read_one(const PolygonRequest& request, const std::string& name, const Grid& terrain,
                 OverlaysRead& read) {
  PolygonLayer layer = open_polygon_layer(request);
  const TransformPtr to_terrain = terrain_transform(layer, request, terrain);
  Overlay overlay{name, {}};
  if (terrain.n_cols > 0) {
    const OGRPolygon edge = rectangle(terrain, 0);
    std::size_t empty = 0;
    for (auto& feature : *layer.layer) {
      const OGRGeometry* own = feature->GetGeometryRef();
      GeometryPtr moved(own == nullptr ? nullptr : own->clone());
      if (moved && to_terrain && moved->transform(to_terrain.get()) != OGRERR_NONE) moved.reset();
      const GeometryPtr shown = moved ? shown_part(*moved, edge, terrain.cell_m / 4) : nullptr;
      if (shown)
        add_parts(*shown, name_of(*feature), overlay);
      else
        ++empty;
    }
    if (overlay.features.empty())
      read.warnings.push_back(fmt::format(
          "{}: none of its {} features lies on the terrain (the page does not show it). Check its "
          "coordinate system.",
          layer.label, empty));
  }
  std::move(layer.notes.begin(), layer.notes.end(), std::back_inserter(read.notes));
  std::move(layer.warnings.begin(), layer.warnings.end(), std::back_inserter(read.warnings));
  return overlay;
}

}  // namespace

OverlaysRead read_overlays(const Scenario& scenario, const Grid& terrain) {
  const GdalScope scope;
  OverlaysRead read;
  std::size_t corners = 0;
  for (const auto& [name, file] : scenario.report.overlays) {
    const PolygonRequest request = request_of(scenario, name, file, terrain.n_cols == 0);
    Overlay overlay = read_one(request, name, terrain, read);
    corners += corners_of(overlay);
    require(corners <= most_overlay_corners,
            fmt::format("report.overlays: {} = {} (with it the overlays have {} corners on the "
                        "terrain, a page holds {}). Cut it to the surroundings of the slide, or "
                        "leave it to a GIS.",
                        name, file, corners, most_overlay_corners));
    if (!overlay.features.empty()) read.overlays.push_back(std::move(overlay));
  }
  return read;
}

}  // namespace sturz
