// SPDX-License-Identifier: Apache-2.0
#include "io/site/flow/named_shapes.hpp"

#include "engine/core/error.hpp"
#include "io/files/plain_text.hpp"
#include "io/files/sha256.hpp"
#include "io/gdal/crs.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <memory>
#include <span>

namespace sturz {
namespace {

using Kind = NamedShape::Kind;

std::vector<Vec2> corners_of(const OGRSimpleCurve& curve) {
  std::vector<Vec2> corners;
  for (int i = 0; i < curve.getNumPoints(); ++i) corners.emplace_back(curve.getX(i), curve.getY(i));
  return corners;
}

/// Points, lines and rings of a geometry, however nested. \return the name of another kind
std::string take_parts(const OGRGeometry& geometry, std::vector<NamedShape>& out) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPoint) {
    const OGRPoint& p = *geometry.toPoint();
    out.push_back({Kind::point, {}, {Vec2(p.getX(), p.getY())}});
  } else if (type == wkbLineString) {
    out.push_back({Kind::line, {}, corners_of(*geometry.toLineString())});
  } else if (type == wkbPolygon) {
    for (const OGRLinearRing* ring : *geometry.toPolygon())
      out.push_back({Kind::polygon, {}, corners_of(*ring)});
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection())
      if (std::string other = take_parts(*part, out); !other.empty()) return other;
  } else {
    return geometry.getGeometryName();
  }
  return {};
}

int find_name_field(const PolygonLayer& layer, const std::string& name) {
  if (name.empty()) return -1;
  OGRFeatureDefn& fields = *layer.layer->GetLayerDefn();
  if (const int index = fields.GetFieldIndex(name.c_str()); index >= 0) return index;
  std::vector<std::string> names;
  for (int i = 0; i < fields.GetFieldCount(); ++i)
    names.emplace_back(fields.GetFieldDefn(i)->GetNameRef());
  throw SetupError(fmt::format("{}: has no field '{}' with names. It has: {}.", layer.label, name,
                               names.empty() ? "none" : comma_separated(names)));
}

void move_to(OGRCoordinateTransformation& transform, const PolygonLayer& layer,
             const std::string& feature, std::vector<Vec2>& corners) {
  for (Vec2& c : corners)
    if (!transform.Transform(1, &c.x(), &c.y()))
      throw SetupError(
          fmt::format("{}: {} cannot be moved to the terrain's system.", layer.label, feature));
}

void require_places(const PolygonLayer& layer, const std::string& feature,
                    const std::vector<Vec2>& corners) {
  for (const Vec2& c : corners)
    require(std::abs(c.x()) <= farthest_coordinate && std::abs(c.y()) <= farthest_coordinate,
            fmt::format("{}: {} reaches out to coordinate {:g} (no place on the earth). Draw it "
                        "again.",
                        layer.label, feature, std::max(std::abs(c.x()), std::abs(c.y()))));
}

}  // namespace

std::vector<NamedShape> read_named_shapes(PolygonLayer& layer, const PolygonRequest& request,
                                          const Grid& terrain, const std::string& name_attribute) {
  const int field = find_name_field(layer, name_attribute);
  const TransformPtr to_terrain = terrain_transform(layer, request, terrain);
  Sha256 hash;
  std::vector<NamedShape> all;
  std::size_t n = 0;
  layer.layer->ResetReading();
  while (const auto read = OGRFeatureUniquePtr(layer.layer->GetNextFeature())) {
    ++n;
    const std::string feature = fmt::format("feature {}", read->GetFID());
    const OGRGeometry* geometry = read->GetGeometryRef();
    require(geometry != nullptr && !geometry->IsEmpty(),
            fmt::format("{}: {} is empty. Draw it or delete it.", layer.label, feature));
    const std::unique_ptr<OGRGeometry> linear(
        geometry->hasCurveGeometry() ? geometry->getLinearGeometry() : geometry->clone());
    std::vector<NamedShape> parts;
    const std::string other = take_parts(*linear, parts);
    require(other.empty(),
            fmt::format("{}: {} is a {}, no {}.", layer.label, feature, other, request.what));
    const bool named = field >= 0 && read->IsFieldSetAndNotNull(field);
    require(field < 0 || named, fmt::format("{}: {} has no value in '{}'. Name it.", layer.label,
                                            feature, name_attribute));
    const std::string name = named ? as_utf8(read->GetFieldAsString(field)) : std::string();
    hash.add_text(name);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      NamedShape& part = parts[i];
      part.name = i == 0 || name.empty() ? name : fmt::format("{} ({})", name, i + 1);
      for (const Vec2& c : part.corners) {
        const std::array<double, 2> place{c.x(), c.y()};
        hash.add_values(std::span<const double>(place));
      }
      if (to_terrain) move_to(*to_terrain, layer, feature, part.corners);
      require_places(layer, feature, part.corners);
      all.push_back(std::move(part));
    }
  }
  require(!all.empty(), fmt::format("{}: layer '{}' has no features. Draw the {}.", layer.label,
                                    layer.layer->GetName(), request.what));
  layer.identity.shape = fmt::format("{} features, {}", n, layer.identity.shape);
  layer.identity.parts["features"] = hash.hex();
  return all;
}

}  // namespace sturz
