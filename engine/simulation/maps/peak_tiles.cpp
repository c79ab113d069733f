// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/maps/peak_tiles.hpp"

#include <algorithm>

namespace sturz {

Window PeakTiles::window() const {
  constexpr int far = 1 << 30, edge = PeakTile::edge;
  int row0 = far, row1 = -1, col0 = far, col1 = -1;
  for (const PeakTile& tile : tiles_)
    for (int k = 0; k < PeakTile::n_cells; ++k)
      if (tile.thickness[static_cast<std::size_t>(k)] > 0) {
        const int row = tile.row0 + k / edge, col = tile.col0 + k % edge;
        row0 = std::min(row0, row), row1 = std::max(row1, row);
        col0 = std::min(col0, col), col1 = std::max(col1, col);
      }
  if (row1 < 0) return {};
  return {row0, col0, row1 - row0 + 1, col1 - col0 + 1};
}

}  // namespace sturz
