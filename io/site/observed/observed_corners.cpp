// SPDX-License-Identifier: Apache-2.0
#include "engine/core/error.hpp"
#include "io/files/sha256.hpp"
#include "io/site/observed/observed_files.hpp"
#include "io/site/polygon_layer.hpp"

#include <fmt/core.h>

#include <span>
#include <utility>

namespace sturz {
namespace {

/// The only part of a collection of one, or the geometry itself.
const OGRGeometry& single_part(const OGRGeometry& geometry) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type != wkbMultiLineString && type != wkbMultiPoint) return geometry;
  const OGRGeometryCollection& parts = *geometry.toGeometryCollection();
  return parts.getNumGeometries() == 1 ? *parts.getGeometryRef(0) : geometry;
}

std::vector<Vec2> corners_of(const OGRGeometry& geometry) {
  std::vector<Vec2> corners;
  if (wkbFlatten(geometry.getGeometryType()) == wkbPoint) {
    const OGRPoint& point = *geometry.toPoint();
    corners.emplace_back(point.getX(), point.getY());
  } else {
    for (const OGRPoint& point : *geometry.toLineString())
      corners.emplace_back(point.getX(), point.getY());
  }
  return corners;
}

/// The one feature of the layer. \param wanted wkbPoint or wkbLineString
CornersRead read_one(const PolygonRequest& request, const Grid& maps, OGRwkbGeometryType wanted,
                     const char* noun) {
  PolygonLayer layer = open_polygon_layer(request);
  const TransformPtr to_maps = terrain_transform(layer, request, maps);
  layer.layer->ResetReading();
  const auto feature = OGRFeatureUniquePtr(layer.layer->GetNextFeature());
  const auto more = OGRFeatureUniquePtr(layer.layer->GetNextFeature());
  const OGRGeometry* geometry = feature ? feature->GetGeometryRef() : nullptr;
  require(geometry != nullptr && !geometry->IsEmpty() && more == nullptr,
          fmt::format("{}: must hold one feature, a {}. Keep only the one that is meant.",
                      layer.label, noun));
  const std::unique_ptr<OGRGeometry> part(single_part(*geometry).clone());
  require(
      wkbFlatten(part->getGeometryType()) == wanted,
      fmt::format("{}: holds a {}, not a {}. Draw the {} as a {}.", layer.label,
                  OGRGeometryTypeToName(geometry->getGeometryType()), noun, request.what, noun));
  Sha256 hash;
  for (const Vec2& p : corners_of(*part)) hash.add_values(std::span<const double>(p.data(), 2));
  require(to_maps == nullptr || part->transform(to_maps.get()) == OGRERR_NONE,
          fmt::format("{}: cannot be moved to the terrain's system ({}). Check {}.", layer.label,
                      gdal_reason(), request.crs_key));
  CornersRead read;
  read.corners = corners_of(*part);
  for (const Vec2& p : read.corners)
    require(p.allFinite() && p.cwiseAbs().maxCoeff() <= farthest_coordinate,
            fmt::format("{}: reaches no place on the earth. Draw it again.", layer.label));
  layer.identity.shape = "1 feature, " + layer.identity.shape;
  layer.identity.parts["features"] = hash.hex();
  read.notes = std::move(layer.notes);
  read.warnings = std::move(layer.warnings);
  read.identity = std::move(layer.identity);
  return read;
}

}  // namespace

CornersRead read_observed_line(const PolygonRequest& request, const Grid& maps) {
  CornersRead read = read_one(request, maps, wkbLineString, "line");
  double length = 0;
  for (std::size_t i = 1; i < read.corners.size(); ++i)
    length += (read.corners[i] - read.corners[i - 1]).norm();
  require(length > 0, fmt::format("{} = {}: the line has no length. Draw it again.", request.key,
                                  request.path));
  return read;
}

CornersRead read_observed_point(const PolygonRequest& request, const Grid& maps) {
  return read_one(request, maps, wkbPoint, "point");
}

}  // namespace sturz
