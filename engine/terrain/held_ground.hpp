// SPDX-License-Identifier: Apache-2.0
/// The part of an elevation raster that is held in memory, and how rough it is: what the terrains
/// of all members share.
#pragma once

#include "engine/terrain/raster.hpp"
#include "engine/terrain/surface_bounds.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace sturz {

/// Everything is counted in rows and columns of the whole raster, so that the same question gets
/// the same bits whatever part of it is held.
struct HeldGround {
  Grid grid;                                        ///< of the whole raster
  Window window;                                    ///< cells that are held
  std::shared_ptr<const Raster<double>> elevation;  ///< of the window [m]
  std::vector<SurfaceBound> bounds;                 ///< per block, at its north-west node [window]
  /// Nodes that may be asked: two fewer on each side where the raster goes on, because the bounds
  /// of a block see so many nodes beyond it.
  Window usable;
  double lowest_m = 0;  ///< lowest known elevation

  /// What is known of all blocks in a square of tile x tile of them, counted from the raster's
  /// corner.
  struct Tile {
    SurfaceBound bound;
    bool known = true;  ///< no unknown node
  };
  static constexpr int tile = 16;
  Window tiles;  ///< that lie wholly between usable nodes, in tiles
  std::vector<Tile> tile_facts;

  /// \param lowest_m  taken for the lowest elevation; absent: that of the window
  /// \throws SetupError if the raster is too small or the window holds no valid 2 x 2 block
  HeldGround(Grid whole, std::shared_ptr<const Raster<double>> part,
             std::optional<double> lowest = {});

  std::size_t index(int row, int col) const {
    return static_cast<std::size_t>(row - window.row0) * window.n_cols + (col - window.col0);
  }
  double node(int row, int col) const { return elevation->values[index(row, col)]; }
  /// The roughest of all blocks of row0..row1, col0..col1 that the raster has, tiles taken whole;
  /// empty where one of these tiles is not held.
  std::optional<Tile> around(int row0, int row1, int col0, int col1) const;

 private:
  void survey_tiles();
};

}  // namespace sturz
