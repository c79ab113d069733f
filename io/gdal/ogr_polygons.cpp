// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/ogr_polygons.hpp"

#include "engine/core/error.hpp"
#include "io/gdal/gdal_handles.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

using GeometryPtr = std::unique_ptr<OGRGeometry>;

void collect(const OGRGeometry& geometry, OGRMultiPolygon& into, std::string& other) {
  switch (wkbFlatten(geometry.getGeometryType())) {
    case wkbPolygon:
      if (!geometry.IsEmpty()) into.addGeometry(&geometry);
      break;
    case wkbMultiPolygon:
    case wkbGeometryCollection:
      for (const OGRGeometry* part : *geometry.toGeometryCollection()) collect(*part, into, other);
      break;
    default:
      other = OGRGeometryTypeToName(geometry.getGeometryType());
  }
}

/// Area of whatever polygons a set operation left; touching lines and points have none.
double polygon_area(const GeometryPtr& geometry) {
  std::string ignored;
  return geometry ? polygons_in(*geometry, ignored)->get_Area() : 0;
}

}  // namespace

std::vector<Vec2> points_of(const OGRLinearRing& ring) {
  std::vector<Vec2> points;
  points.reserve(static_cast<std::size_t>(ring.getNumPoints()));
  for (int i = 0; i < ring.getNumPoints(); ++i) points.emplace_back(ring.getX(i), ring.getY(i));
  return points;
}

PolygonsPtr polygons_in(const OGRGeometry& geometry, std::string& other) {
  auto polygons = std::make_unique<OGRMultiPolygon>();
  collect(geometry, *polygons, other);
  return polygons;
}

double farthest_coordinate_of(const OGRMultiPolygon& polygons) {
  double farthest = 0;
  for (const OGRPolygon* polygon : polygons)
    for (const OGRLinearRing* ring : *polygon)
      for (const Vec2& p : points_of(*ring))
        farthest = p.allFinite() ? std::max(farthest, p.cwiseAbs().maxCoeff()) : INFINITY;
  return farthest;
}

PolygonsPtr united(const std::vector<const OGRMultiPolygon*>& all, const std::string& label) {
  OGRMultiPolygon together;
  for (const OGRMultiPolygon* polygons : all)
    for (const OGRPolygon* polygon : *polygons) together.addGeometry(polygon);
  const GeometryPtr one(together.UnionCascaded());
  require(one != nullptr, fmt::format("{}: its features cannot be united ({}). Merge them first.",
                                      label, gdal_reason()));
  std::string ignored;
  return polygons_in(*one, ignored);
}

double shared_area(const OGRMultiPolygon& a, const OGRMultiPolygon& b) {
  return a.Intersects(&b) ? polygon_area(GeometryPtr(a.Intersection(&b))) : 0;
}

double area_outside(const OGRMultiPolygon& polygons, const OGRPolygon& known) {
  return polygon_area(GeometryPtr(polygons.Difference(&known)));
}

OGRPolygon rectangle(const Grid& g, double margin_m) {
  OGRLinearRing ring;
  ring.addPoint(g.west_m - margin_m, g.south_m() - margin_m);
  ring.addPoint(g.east_m() + margin_m, g.south_m() - margin_m);
  ring.addPoint(g.east_m() + margin_m, g.north_m + margin_m);
  ring.addPoint(g.west_m - margin_m, g.north_m + margin_m);
  ring.closeRings();
  OGRPolygon polygon;
  polygon.addRing(&ring);
  return polygon;
}

double lay_down(const OGRMultiPolygon& polygons, double weight, PolygonCover& cover) {
  double area = 0;
  for (const OGRPolygon* polygon : polygons) {
    double sign = 1;  // the first ring is the outer one
    for (const OGRLinearRing* ring : *polygon) {
      const auto points = points_of(*ring);
      cover.add_ring(points, sign * weight);
      area += sign * std::abs(ring_area(points));
      sign = -1;
    }
  }
  return area;
}

}  // namespace sturz
