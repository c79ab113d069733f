// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/maps/tile_directory.hpp"

#include <algorithm>

namespace sturz {
namespace {

/// The directory grows by this margin, so that a spreading flow seldom moves it [tiles].
int margin(int n) { return 4 + n / 4; }

}  // namespace

void TileDirectory::cover(const Window& w) {
  if (w.n_cells() == 0) return;
  int row0 = w.row0 / edge, row1 = (w.row0 + w.n_rows - 1) / edge + 1;
  int col0 = w.col0 / edge, col1 = (w.col0 + w.n_cols - 1) / edge + 1;
  if (row0 >= row0_ && row1 <= row0_ + n_rows_ && col0 >= col0_ && col1 <= col0_ + n_cols_) return;
  if (n_rows_ > 0) {
    row0 = std::min(row0, row0_), row1 = std::max(row1, row0_ + n_rows_);
    col0 = std::min(col0, col0_), col1 = std::max(col1, col0_ + n_cols_);
  }
  const int dr = margin(row1 - row0), dc = margin(col1 - col0);
  TileDirectory larger;
  larger.row0_ = std::max(0, row0 - dr), larger.col0_ = std::max(0, col0 - dc);
  larger.n_rows_ = row1 + dr - larger.row0_, larger.n_cols_ = col1 + dc - larger.col0_;
  larger.numbers_.assign(
      static_cast<std::size_t>(larger.n_rows_) * static_cast<std::size_t>(larger.n_cols_), -1);
  for (int row = row0_; row < row0_ + n_rows_; ++row)
    for (int col = col0_; col < col0_ + n_cols_; ++col) larger.at(row, col) = at(row, col);
  *this = std::move(larger);
}

}  // namespace sturz
