// SPDX-License-Identifier: Apache-2.0
/// Where a tile of the hazard grid is found: a number for every tile of a part of the grid.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

class TileDirectory {
 public:
  static constexpr int edge = 16;  ///< cells of a tile's side
  static constexpr int n_cells = edge * edge;

  /// Makes room for the tiles over this part of the grid, at least; numbers stay, new ones are -1.
  void cover(const Window&);
  /// Number of a tile inside what `cover` made room for.
  std::int32_t& at(int tile_row, int tile_col) {
    return numbers_[static_cast<std::size_t>(tile_row - row0_) * static_cast<std::size_t>(n_cols_) +
                    static_cast<std::size_t>(tile_col - col0_)];
  }

 private:
  int row0_ = 0, col0_ = 0, n_rows_ = 0, n_cols_ = 0;  ///< [tiles]
  std::vector<std::int32_t> numbers_;
};

}  // namespace sturz
