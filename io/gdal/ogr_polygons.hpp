// SPDX-License-Identifier: Apache-2.0
/// OGR geometries as sets of polygons: picking, uniting, intersecting. Included by .cpp files only.
#pragma once

#include "engine/terrain/raster.hpp"
#include "io/site/polygon_cover.hpp"

#include <ogr_geometry.h>

#include <memory>
#include <string>
#include <vector>

namespace sturz {

using PolygonsPtr = std::unique_ptr<OGRMultiPolygon>;

/// The polygons of a geometry, however nested. `other` gets the name of a kind that is none.
PolygonsPtr polygons_in(const OGRGeometry& geometry, std::string& other);

/// What at least one of them covers. \throws SetupError with the library's reason
PolygonsPtr united(const std::vector<const OGRMultiPolygon*>& all, const std::string& label);
/// Area that both cover [m2].
double shared_area(const OGRMultiPolygon& a, const OGRMultiPolygon& b);
/// Area of `polygons` beyond `known` [m2].
double area_outside(const OGRMultiPolygon& polygons, const OGRPolygon& known);

/// Largest absolute coordinate; infinity where one is not finite.
double farthest_coordinate_of(const OGRMultiPolygon& polygons);

/// The ring's corners; the last repeats the first.
std::vector<Vec2> points_of(const OGRLinearRing& ring);

/// The grid's extent, widened on all sides.
OGRPolygon rectangle(const Grid& grid, double margin_m);

/// Adds all polygons, holes negative, to `cover`. \return their exact area [m2]
double lay_down(const OGRMultiPolygon& polygons, double weight, PolygonCover& cover);

}  // namespace sturz
