// SPDX-License-Identifier: Apache-2.0
/// The border of a set of cells as straight lines of the map.
#pragma once

#include "engine/terrain/raster.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

struct MapLine {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< [m]
  bool operator==(const MapLine&) const = default;
};

/// Edges between cells that are set (not 0) and cells that are not, or the raster's end. Edges in
/// one row or column that touch are one line.
std::vector<MapLine> cell_outline(const Raster<std::uint8_t>& cells);

}  // namespace sturz
