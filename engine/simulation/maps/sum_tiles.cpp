// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/maps/sum_tiles.hpp"

#include <algorithm>
#include <bit>
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

void SumTiles::add(const SumTiles& other) {
  for (std::size_t from = 0; from < other.open_.size(); ++from) {
    const Open& tile = other.open_[from];
    const std::size_t to = slot_at(tile.tile_row, tile.tile_col);
    mark_rows(to, tile.rows);
    for (unsigned rows = tile.rows; rows != 0; rows &= rows - 1) {
      const int first = std::countr_zero(rows) * edge;
      for (int k = first; k < first + edge; ++k) {
        cells(to)[k] += other.cells(from)[k];
        under(to)[k] += other.under(from)[k];
      }
    }
  }
}

void SumTiles::open_as(const SumTiles& other) {
  for (const Open& tile : other.open_) slot_at(tile.tile_row, tile.tile_col);
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
