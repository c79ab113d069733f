// SPDX-License-Identifier: Apache-2.0
/// What a flow can take of the bed: how deep each cell of the ground may still be worn, and how
/// deep it was. One member's own; memory and time follow the cells that its flow came over.
#pragma once

#include "engine/terrain/raster.hpp"

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

namespace sturz {

/// The bed before the flow came; shared by all members.
struct BedSource {
  double depth_m = 0;  ///< vertical; infinite: unlimited. Multiplies the pattern where there is one
  /// By cell of a part of the ground's grid: a share or a depth; nothing lies beyond it. Null: the
  /// same everywhere.
  std::shared_ptr<const Raster<double>> pattern;
  Window at;  ///< where the pattern's cells lie on the ground's grid

  /// Depth that can be taken of a cell [m].
  double depth(int row, int col) const {
    if (!pattern) return depth_m;
    if (!at.contains(row, col)) return 0;
    const double share = pattern->at(row - at.row0, col - at.col0);
    return share > 0 ? share * depth_m : 0;
  }
};

class BedSupply {
 public:
  struct Cell {
    double left = 0;    ///< vertical [m]
    double eroded = 0;  ///< vertical [m]
    // Of the present step.
    double wanted = 0;  ///< by all columns together [m]
    double room = 0;    ///< that the column with the widest reach sees [m]
    double given = 0;   ///< share of what is wanted
  };

  /// \param repeats_x, repeats_y the grid is one period wide: cells beyond it are those on the
  /// other side
  BedSupply(Grid grid, BedSource source, bool repeats_x, bool repeats_y);

  const Grid& grid() const { return grid_; }
  /// The cell, from its repeated row and column; nullptr beyond the grid. It stays where
  /// it is.
  Cell* cell(int row, int col);

  /// Volume taken of the bed so far [m^3].
  double eroded_volume_m3() const;
  /// Calls visit(row, col, eroded [m]) for every cell that something was taken of, tile by tile in
  /// the order in which the flow came over them.
  template <class Visit>
  void visit_eroded(Visit&& visit) const {
    for (const Tile& tile : tiles_)
      for (int k = 0; k < edge * edge; ++k)
        if (const double eroded = tile.cells[static_cast<std::size_t>(k)].eroded; eroded > 0)
          visit(tile.row0 + k / edge, tile.col0 + k % edge, eroded);
  }
  std::size_t bytes() const {
    return tiles_.size() * sizeof(Tile) + places_.size() * sizeof(std::int32_t);
  }

 private:
  static constexpr int edge = 16;
  struct Tile {
    int row0 = 0, col0 = 0;
    std::array<Cell, std::size_t{edge} * edge> cells;
  };
  Tile& open(int tile_row, int tile_col);

  Grid grid_;
  BedSource source_;
  bool repeats_x_, repeats_y_;
  int tiles_across_;
  std::vector<std::int32_t> places_;  ///< of each tile of the grid among `tiles_`; -1: none yet
  std::deque<Tile> tiles_;
};

/// Mean eroded depth over the cells of another grid [n_rows][n_cols] of its window `part`, by exact
/// areas; what lies beyond it is left out.
std::vector<float> eroded_depth_on(const BedSupply&, const Grid& whole, const Window& part);

}  // namespace sturz
