// SPDX-License-Identifier: Apache-2.0
/// Cells of the hazard grid that a flow has touched, in tiles: time and memory follow the flow, not
/// the raster it lies on, nor the rectangle around it.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/simulation/member_result.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <deque>
#include <vector>

namespace sturz {

/// Largest values of a cell so far.
struct CellPeak {
  float thickness = 0, speed = 0, energy = 0, pressure = 0, arrival = nan_f, deposit = 0;
  bool covered = false;  ///< by the deposit
};

/// Peaks of every tile that was ever touched, and the sums of one instant in those that are touched
/// now. A tile that is touched gets a slot until `clear_sums`.
class PeakTiles {
 public:
  static constexpr int edge = 16;  ///< cells
  static constexpr int n_cells = edge * edge;
  /// Momentum x, y, z [kg m/s] and kinetic energy [J] of one instant in a cell.
  using Motion = Eigen::Array4d;

  struct Tile {
    int row0 = 0, col0 = 0;  ///< of its first cell on the grid
    int slot = -1;
    std::array<CellPeak, n_cells> peak;  ///< rows from the north
  };

  /// Makes room for tiles over this part of the grid, at least.
  void cover(const Window&);
  /// The number of mass sums per cell: one of each particle set. Before anything is added.
  void set_n_sets(std::size_t n) { mass_.resize(n); }
  std::size_t n_sets() const { return mass_.size(); }

  /// Slot of the tile that holds a cell, inside what `cover` made room for.
  std::size_t slot_at(int tile_row, int tile_col) {
    const int tile = directory_[static_cast<std::size_t>(tile_row - row0_) * n_cols_ +
                                static_cast<std::size_t>(tile_col - col0_)];
    if (tile >= 0 && tiles_[static_cast<std::size_t>(tile)].slot >= 0)
      return static_cast<std::size_t>(tiles_[static_cast<std::size_t>(tile)].slot);
    return open(tile_row, tile_col);
  }
  double* mass(std::size_t set, std::size_t slot) { return &mass_[set][slot * n_cells]; }
  /// How often the cell is covered by the areas that particles stand for [1].
  double* coverage(std::size_t slot) { return &coverage_[slot * n_cells]; }
  Motion* motion(std::size_t slot) { return &motion_[slot * n_cells]; }
  /// One bit for every cell of a tile's row that was added to.
  std::uint16_t* touched(std::size_t slot) { return &touched_[slot * edge]; }

  /// Calls use(tile's peaks, slot, cell within the tile) for every cell that was added to, tiles in
  /// the order in which they were opened, and forgets the sums.
  template <class Use>
  void take_sums(Use&& use);

  const std::deque<Tile>& tiles() const { return tiles_; }
  std::deque<Tile>& tiles() { return tiles_; }
  /// The least part of the grid that holds every cell of some thickness.
  Window window() const;

 private:
  std::size_t open(int tile_row, int tile_col);

  int row0_ = 0, col0_ = 0, n_rows_ = 0, n_cols_ = 0;  ///< of the directory, in tiles
  std::vector<std::int32_t> directory_;                ///< number of a tile; -1: never touched
  std::deque<Tile> tiles_;
  std::vector<std::int32_t> open_;         ///< [slot] number of the tile
  std::vector<std::vector<double>> mass_;  ///< [set][slot x cells], zero between instants [kg]
  std::vector<double> coverage_;           ///< the same
  std::vector<Motion> motion_;             ///< [slot x cells], zero between instants
  std::vector<std::uint16_t> touched_;     ///< [slot x rows]
};

template <class Use>
void PeakTiles::take_sums(Use&& use) {
  for (std::size_t slot = 0; slot < open_.size(); ++slot) {
    Tile& tile = tiles_[static_cast<std::size_t>(open_[slot])];
    for (int row = 0; row < edge; ++row) {
      unsigned bits = touched_[slot * edge + static_cast<std::size_t>(row)];
      touched_[slot * edge + static_cast<std::size_t>(row)] = 0;
      for (; bits != 0; bits &= bits - 1) {
        const auto cell = static_cast<std::size_t>(row) * edge + std::countr_zero(bits);
        use(tile.peak[cell], slot, cell);
        for (auto& of_set : mass_) of_set[slot * n_cells + cell] = 0;
        coverage_[slot * n_cells + cell] = 0;
        motion_[slot * n_cells + cell].setZero();
      }
    }
    tile.slot = -1;
  }
  open_.clear();
}

}  // namespace sturz
