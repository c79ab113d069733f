// SPDX-License-Identifier: Apache-2.0
/// Sums over the cells of one instant, in tiles that the particles touch now.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/simulation/maps/tile_directory.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

/// What a cell sums; in this order within `CellSums`.
enum class CellSum {
  volume,
  mass,
  momentum_x,
  momentum_y,
  momentum_z,
  energy,
  coverage,
  first_mass
};
constexpr int n_cell_sums = 8;
/// Sums of one cell, or what one particle adds to them: m3, kg, kg m/s, J, 1, and kg of the first
/// set alone. One vector instruction adds them all; in float, as the maps are, for a cell sums some
/// dozen parts.
using CellSums = Eigen::Array<float, n_cell_sums, 1>;

class SumTiles {
 public:
  static constexpr int edge = TileDirectory::edge;
  static constexpr int n_cells = TileDirectory::n_cells;

  /// A tile that was touched since `clear`.
  struct Open {
    int tile_row = 0, tile_col = 0;
    std::uint32_t rows = 0;  ///< one bit for each row that was added to
  };

  /// Makes room for the tiles over this part of the grid, at least.
  void cover(const Window& w) { directory_.cover(w); }
  /// Slot of a tile inside what `cover` made room for, opened where it was not.
  std::size_t slot_at(int tile_row, int tile_col) {
    const std::int32_t slot = directory_.at(tile_row, tile_col);
    return slot >= 0 ? static_cast<std::size_t>(slot) : open(tile_row, tile_col);
  }
  /// [n_cells] of a tile; valid until the next tile is opened.
  CellSums* cells(std::size_t slot) { return &sums_[slot * n_cells]; }
  const CellSums* cells(std::size_t slot) const { return &sums_[slot * n_cells]; }
  /// [n_cells] of a tile: share of each cell that lies under the particles themselves, without the
  /// width that they are spread over; valid as long as `cells`.
  float* under(std::size_t slot) { return &under_[slot * n_cells]; }
  const float* under(std::size_t slot) const { return &under_[slot * n_cells]; }
  void mark_rows(std::size_t slot, std::uint32_t rows) { open_[slot].rows |= rows; }
  /// In the order in which they were opened.
  const std::vector<Open>& tiles() const { return open_; }
  /// Adds all sums of `other` to these; room for its tiles must have been made.
  void add(const SumTiles& other);
  /// Opens every tile that `other` has open.
  void open_as(const SumTiles& other);
  /// Forgets all sums.
  void clear();

 private:
  std::size_t open(int tile_row, int tile_col);

  TileDirectory directory_;
  std::vector<Open> open_;      ///< [slot]
  std::vector<CellSums> sums_;  ///< [slot][cell], zero between instants
  std::vector<float> under_;    ///< [slot][cell], zero between instants
};

}  // namespace sturz
