// SPDX-License-Identifier: Apache-2.0
/// Areas of a map as polygons.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/terrain/raster.hpp"

#include <cstdint>
#include <map>
#include <string>

namespace sturz {

/// All cells that are set (not 0) as one multi-polygon with holes along the cells' edges, as ISO
/// WKB; cells that touch at a corner only are polygons of their own. Empty where none is set.
/// \throws IoError when the library fails
std::string cells_as_polygons(const Raster<std::uint8_t>& cells);

/// The same for each value but 0 that some cell has. \throws IoError when the library fails;
/// Cancelled
std::map<std::uint8_t, std::string> classes_as_polygons(const Raster<std::uint8_t>& cells,
                                                        CancelFlag cancel = {});

}  // namespace sturz
