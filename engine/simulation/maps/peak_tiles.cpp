// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/maps/peak_tiles.hpp"

#include "engine/core/error.hpp"

#include <algorithm>

namespace sturz {
namespace {

/// The directory grows by this margin, so that a spreading flow seldom moves it [tiles].
int margin(int n) { return 4 + n / 4; }

}  // namespace

void PeakTiles::cover(const Window& w) {
  if (w.n_cells() == 0) return;
  int row0 = w.row0 / edge, row1 = (w.row0 + w.n_rows - 1) / edge + 1;
  int col0 = w.col0 / edge, col1 = (w.col0 + w.n_cols - 1) / edge + 1;
  if (row0 >= row0_ && row1 <= row0_ + n_rows_ && col0 >= col0_ && col1 <= col0_ + n_cols_) return;
  if (n_rows_ > 0) {
    row0 = std::min(row0, row0_), row1 = std::max(row1, row0_ + n_rows_);
    col0 = std::min(col0, col0_), col1 = std::max(col1, col0_ + n_cols_);
  }
  const int dr = margin(row1 - row0), dc = margin(col1 - col0);
  row0 = std::max(0, row0 - dr), col0 = std::max(0, col0 - dc);
  row1 += dr, col1 += dc;
  const auto width = static_cast<std::size_t>(col1 - col0);
  std::vector<std::int32_t> directory(static_cast<std::size_t>(row1 - row0) * width, -1);
  for (std::size_t k = 0; k < tiles_.size(); ++k)
    directory[static_cast<std::size_t>(tiles_[k].row0 / edge - row0) * width +
              static_cast<std::size_t>(tiles_[k].col0 / edge - col0)] =
        static_cast<std::int32_t>(k);
  directory_.swap(directory);
  row0_ = row0, col0_ = col0, n_rows_ = row1 - row0, n_cols_ = col1 - col0;
}

std::size_t PeakTiles::open(int tile_row, int tile_col) {
  std::int32_t& number =
      directory_[static_cast<std::size_t>(tile_row - row0_) * static_cast<std::size_t>(n_cols_) +
                 static_cast<std::size_t>(tile_col - col0_)];
  if (number < 0) {
    number = static_cast<std::int32_t>(tiles_.size());
    Tile& tile = tiles_.emplace_back();
    tile.row0 = tile_row * edge, tile.col0 = tile_col * edge;
  }
  const std::size_t slot = open_.size();
  open_.push_back(number);
  tiles_[static_cast<std::size_t>(number)].slot = static_cast<int>(slot);
  if (touched_.size() < (slot + 1) * edge) {
    touched_.resize((slot + 1) * edge, 0);
    coverage_.resize((slot + 1) * n_cells, 0.0);
    motion_.resize((slot + 1) * n_cells, Motion::Zero());
    for (auto& of_set : mass_) of_set.resize((slot + 1) * n_cells, 0.0);
  }
  return slot;
}

Window PeakTiles::window() const {
  constexpr int far = 1 << 30;
  int row0 = far, row1 = -1, col0 = far, col1 = -1;
  for (const Tile& tile : tiles_)
    for (int k = 0; k < n_cells; ++k)
      if (tile.peak[static_cast<std::size_t>(k)].thickness > 0) {
        const int row = tile.row0 + k / edge, col = tile.col0 + k % edge;
        row0 = std::min(row0, row), row1 = std::max(row1, row);
        col0 = std::min(col0, col), col1 = std::max(col1, col);
      }
  if (row1 < 0) return {};
  return {row0, col0, row1 - row0 + 1, col1 - col0 + 1};
}

}  // namespace sturz
