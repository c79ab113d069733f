// SPDX-License-Identifier: Apache-2.0
/// Points, lines and rings of the map as geometries that vector layers hold.
#pragma once

#include "engine/core/vec.hpp"

#include <string>
#include <vector>

namespace sturz {

/// ISO WKB, little endian, of a place on the map [m].
std::string point_as_wkb(Vec2 place);
/// Of a line through two corners at least.
std::string line_as_wkb(const std::vector<Vec2>& corners);
/// Of the areas within closed rings, as a multi-polygon: a ring inside another one is its hole.
/// Empty for no rings. \throws IoError when the library fails
std::string rings_as_wkb(const std::vector<std::vector<Vec2>>& rings);

}  // namespace sturz
