// SPDX-License-Identifier: Apache-2.0
/// Points, lines and polygons of any layer that OGR reads, with their names, in the terrain's
/// coordinate system. Included by .cpp files only.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"
#include "io/site/polygon_layer.hpp"

#include <string>
#include <vector>

namespace sturz {

struct NamedShape {
  enum class Kind { point, line, polygon } kind = Kind::point;
  std::string name;  ///< of its feature, empty where no field was asked for
  std::vector<Vec2> corners;
};

/// All parts of all features, in file order; one of a feature with several parts is named "name
/// (2)" from the second on. A polygon gives its rings. \param name_attribute field with the names;
/// empty: none \throws SetupError naming key and file: no coordinate system, empty layer or
/// geometry, other
///   kinds of geometry, no such field
std::vector<NamedShape> read_named_shapes(PolygonLayer&, const PolygonRequest&, const Grid& terrain,
                                          const std::string& name_attribute);

}  // namespace sturz
