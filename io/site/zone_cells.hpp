// SPDX-License-Identifier: Apache-2.0
/// Polygons of a zone of the bed, as the terrain's cells whose centre they hold.
#pragma once

#include "engine/terrain/raster.hpp"
#include "io/site/polygon_request.hpp"
#include "scenarios/input_identity.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace sturz {

struct ZoneCells {
  std::vector<std::size_t> cells;  ///< indices on the window's grid, rising, each once
  /// Of the whole terrain. Where features overlap beyond the window, a cell counts in each of them.
  std::size_t n_on_terrain = 0;
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
  InputIdentity identity;  ///< of what was read
};

/// All features of the layer together; what lies beyond the terrain is left out.
///
/// \param terrain without a system of its own the coordinates are taken as they are
/// \throws SetupError naming key and file: missing file or layer; empty layer or polygon; points or
///   lines; no coordinate system; no cell covered
/// \param held the window whose cells are listed
ZoneCells read_zone_cells(const PolygonRequest& request, const Grid& terrain, const Window& held);
inline ZoneCells read_zone_cells(const PolygonRequest& request, const Grid& terrain) {
  return read_zone_cells(request, terrain, whole_of(terrain));
}

}  // namespace sturz
