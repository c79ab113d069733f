// SPDX-License-Identifier: Apache-2.0
#include "io/site/polygon_layer.hpp"

#include "engine/core/error.hpp"
#include "io/files/sha256.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/input_files.hpp"
#include "io/gdal/raster_identity.hpp"
#include "io/site/release/named_features.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sturz {
namespace {

using GeometryPtr = std::unique_ptr<OGRGeometry>;

OGRLayer& choose_layer(PolygonLayer& layer, const PolygonRequest& request) {
  GDALDataset& dataset = *layer.dataset.dataset;
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(dataset.GetLayerCount()));
  for (int i = 0; i < dataset.GetLayerCount(); ++i)
    names.emplace_back(dataset.GetLayer(i)->GetName());
  require(!names.empty(), layer.label + ": holds no layer. Export the polygons again.");
  if (request.layer.empty()) {
    if (names.size() > 1)
      layer.notes.push_back(fmt::format("{}: layer '{}' is used, the first of {}", layer.label,
                                        names[0], comma_separated(names)));
    return *dataset.GetLayer(0);
  }
  OGRLayer* chosen = dataset.GetLayerByName(request.layer.c_str());
  if (chosen == nullptr)
    throw SetupError(fmt::format("{}: has no layer '{}' ({}). It has: {}.", layer.label,
                                 request.layer, request.layer_key, comma_separated(names)));
  return *chosen;
}

/// Before anything is asked of its fields: a layer of lines has mostly other fields, too.
void refuse_other_shapes(const PolygonLayer& layer, const PolygonRequest& request) {
  const OGRwkbGeometryType type = wkbFlatten(layer.layer->GetGeomType());
  const bool other = type == wkbPoint || type == wkbMultiPoint || type == wkbLineString ||
                     type == wkbMultiLineString || type == wkbCircularString ||
                     type == wkbCompoundCurve || type == wkbMultiCurve;
  if (!other) return;
  throw SetupError(
      fmt::format("{}: layer '{}' holds features of type {}, not polygons. Draw the "
                  "{} as polygons.",
                  layer.label, layer.layer->GetName(), OGRGeometryTypeToName(type), request.what));
}

/// What the steps below share.
struct Reading {
  PolygonLayer& layer;
  const PolygonRequest& request;
  TransformPtr to_terrain;
  Sha256 hash;  ///< of corners and values as the file has them
};

/// Corners in the file's own system: where they come to lie is another matter.
void add_corners(Sha256& hash, const OGRMultiPolygon& polygons) {
  std::vector<double> numbers;
  for (const OGRPolygon* polygon : polygons)
    for (const OGRLinearRing* ring : *polygon) {
      numbers.push_back(ring->getNumPoints());
      for (const Vec2& p : points_of(*ring)) numbers.insert(numbers.end(), {p.x(), p.y()});
    }
  hash.add_values(std::span<const double>(numbers));
}

PolygonsPtr mended(PolygonLayer& layer, const OGRMultiPolygon& polygons, const std::string& name) {
  const std::string reason = gdal_reason("it crosses itself");
  const GeometryPtr valid(polygons.MakeValid());
  std::string ignored;
  PolygonsPtr clean = valid ? polygons_in(*valid, ignored) : std::make_unique<OGRMultiPolygon>();
  layer.notes.push_back(fmt::format("{}: {} was not a valid polygon ({}); mended, area {:.6g} m2",
                                    layer.label, name, reason, clean->get_Area()));
  return clean;
}

PolygonsPtr polygons_of(Reading& reading, const OGRGeometry& geometry, const std::string& name) {
  PolygonLayer& layer = reading.layer;
  GeometryPtr linear(geometry.hasCurveGeometry() ? geometry.getLinearGeometry() : geometry.clone());
  if (geometry.hasCurveGeometry())
    layer.notes.push_back(
        fmt::format("{}: the curves of {} were replaced by short lines", layer.label, name));
  linear->flattenTo2D();
  std::string other;
  PolygonsPtr polygons = polygons_in(*linear, other);
  if (!other.empty())
    throw SetupError(fmt::format("{}: {} is a {}, not a polygon. Draw the {} as polygons.",
                                 layer.label, name, other, reading.request.what));
  add_corners(reading.hash, *polygons);
  if (reading.to_terrain && polygons->transform(reading.to_terrain.get()) != OGRERR_NONE)
    throw SetupError(fmt::format(
        "{}: {} cannot be moved to the terrain's system ({}). Check {}.", layer.label, name,
        gdal_reason(),
        reading.request.crs_key.empty() ? "the file's own system" : reading.request.crs_key));
  const double farthest = farthest_coordinate_of(*polygons);
  require(
      farthest <= farthest_coordinate,
      fmt::format("{}: {} reaches out to coordinate {:g} (no place on the earth). Draw it again.",
                  layer.label, name, farthest));
  if (polygons->IsValid()) return polygons;
  return mended(layer, *polygons, name);
}

}  // namespace

TransformPtr terrain_transform(PolygonLayer& layer, const PolygonRequest& request,
                               const Grid& terrain) {
  OGREnvelope box;
  if (layer.layer->GetExtent(&box, true) != OGRERR_NONE) box = {};  // an empty layer has none
  const OGRSpatialReference* own = layer.layer->GetSpatialRef();
  if (terrain.crs_wkt.empty() && !request.without_terrain) {
    layer.identity.shape = crs_identity(OGRSpatialReference());
    if (own != nullptr || !request.crs.empty())
      layer.notes.push_back(layer.label +
                            ": its coordinates are taken as they are, because the terrain "
                            "has no coordinate system");
    return nullptr;
  }
  std::string note, warning;
  const OGRSpatialReference from = settle_crs(own,
                                              {layer.label, request.crs_key, request.crs,
                                               request.fallback_crs_key, request.fallback_crs},
                                              {box.MinX, box.MaxX, box.MinY, box.MaxY, 0}, note)
                                       .crs;
  layer.identity.shape = crs_identity(from);
  if (!note.empty()) layer.notes.push_back(note);
  if (request.without_terrain) return nullptr;
  const OGRSpatialReference to = crs_from_wkt(terrain.crs_wkt);
  TransformPtr to_terrain = transform_between(from, to, layer.label, &warning);
  if (!warning.empty()) layer.warnings.push_back(warning);
  if (to_terrain)
    layer.notes.push_back(
        fmt::format("{}: reprojected from {} to {}", layer.label, crs_name(from), crs_name(to)));
  return to_terrain;
}

PolygonLayer open_polygon_layer(const PolygonRequest& request) {
  const InputFile file = find_input(request.key, request.path, request.directory);
  PolygonLayer layer;
  layer.label = file.label;
  layer.dataset = open_dataset(file.path, file.label, GDAL_OF_VECTOR);
  layer.identity.role = request.key;
  layer.identity.file = file.path;
  layer.layer = &choose_layer(layer, request);
  if (!request.thickness_attribute.empty() || !request.volume_attribute.empty() ||
      !request.start_time_attribute.empty() || !request.feature.empty())
    refuse_other_shapes(layer, request);
  return layer;
}

std::vector<PolygonFeature> read_features(
    PolygonLayer& layer, const PolygonRequest& request, const Grid& terrain,
    const std::function<void(OGRFeature&, PolygonFeature&)>& read_fields) {
  Reading reading{layer, request, terrain_transform(layer, request, terrain), {}};
  std::optional<GIntBig> only;
  if (!request.feature.empty()) only = wanted_feature(layer, request);
  std::vector<PolygonFeature> features;
  layer.layer->ResetReading();
  while (const auto read = OGRFeatureUniquePtr(layer.layer->GetNextFeature())) {
    if (only && read->GetFID() != *only) continue;
    PolygonFeature feature;
    feature.name = fmt::format("feature {}", read->GetFID());
    const OGRGeometry* geometry = read->GetGeometryRef();
    require(geometry != nullptr && !geometry->IsEmpty(),
            fmt::format("{}: {} is empty (no polygon drawn). Draw it or delete it.", layer.label,
                        feature.name));
    feature.polygons = polygons_of(reading, *geometry, feature.name);
    require(feature.polygons->get_Area() > 0,
            fmt::format("{}: {} has no area. Draw it again.", layer.label, feature.name));
    if (read_fields) read_fields(*read, feature);
    reading.hash.add_values(std::span<const double>(&feature.thickness_m, 1));
    // Only where it is asked for: what was hashed without it stays the same.
    if (!request.start_time_attribute.empty())
      reading.hash.add_values(std::span<const double>(&feature.start_s, 1));
    features.push_back(std::move(feature));
  }
  require(!features.empty(),
          fmt::format("{}: layer '{}' has no features (an empty {}). Draw the "
                      "{} polygon.",
                      layer.label, layer.layer->GetName(), request.what, request.what));
  layer.identity.shape = fmt::format("{} features, {}", features.size(), layer.identity.shape);
  layer.identity.parts["features"] = reading.hash.hex();
  return features;
}

std::string places_text(const OGREnvelope& polygon, const Grid& terrain) {
  return fmt::format(
      "polygon x {:.10g} to {:.10g}, y {:.10g} to {:.10g}; terrain x {:.10g} to {:.10g}, y {:.10g} "
      "to {:.10g}",
      polygon.MinX, polygon.MaxX, polygon.MinY, polygon.MaxY, terrain.west_m, terrain.east_m(),
      terrain.south_m(), terrain.north_m);
}

}  // namespace sturz
