// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/maps/sum_tiles.hpp"

#include <algorithm>
#include <cstddef>

namespace sturz {

std::size_t SumTiles::open(int tile_row, int tile_col) {
  const std::size_t slot = open_.size();
  directory_.at(tile_row, tile_col) = static_cast<std::int32_t>(slot);
  open_.push_back({tile_row, tile_col, 0});
  const std::size_t room = (slot + 1) * n_cells;
  if (sums_.size() < room) {
    sums_.resize(std::max(room, 2 * sums_.size()), CellSums::Zero());
    under_.resize(sums_.size());
  }
  return slot;
}

void SumTiles::clear() {
  for (std::size_t slot = 0; slot < open_.size(); ++slot) {
    const Open& tile = open_[slot];
    directory_.at(tile.tile_row, tile.tile_col) = -1;
    for (int row = 0; row < edge; ++row)
      if (tile.rows >> row & 1U) {
        std::fill_n(cells(slot) + std::ptrdiff_t{edge} * row, edge, CellSums::Zero());
        std::fill_n(under(slot) + std::ptrdiff_t{edge} * row, edge, 0.0F);
      }
  }
  open_.clear();
}

}  // namespace sturz
