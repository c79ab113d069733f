// SPDX-License-Identifier: Apache-2.0
/// Largest values of the cells that a flow has touched, in tiles: time and memory follow the flow,
/// not the raster it lies on, nor the rectangle around it.
#pragma once

#include "engine/simulation/maps/tile_directory.hpp"

#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

namespace sturz {

/// Of a flow, or of one of its materials, over the cells of a tile, rows from the north.
struct CellPeaks {
  static constexpr int n_cells = TileDirectory::n_cells;
  static constexpr float never = std::numeric_limits<float>::infinity();
  template <class T>
  using PerCell = std::array<T, n_cells>;

  PerCell<float> thickness{}, speed{}, energy{}, pressure{};
  PerCell<float> arrival{};  ///< first time, or `never`
  /// What a cell held at one of the last instants, zero where it was not touched.
  struct Instant {
    PerCell<float> thickness{}, speed{}, energy{};
  };
  Instant last, before;

  CellPeaks() { arrival.fill(never); }
};

struct PeakTile : CellPeaks {
  static constexpr int edge = TileDirectory::edge;

  int row0 = 0, col0 = 0;  ///< of its first cell on the grid
  PerCell<float> deposit{};
  PerCell<bool> covered{};  ///< by the deposit
  /// Of grains and of liquid; empty where they are not told apart, as are the next two.
  std::vector<CellPeaks> of_set;
  std::vector<float> fullest;          ///< [n_cells] thickest instant so far [m]
  std::vector<float> liquid_fraction;  ///< [n_cells] liquid's share of the volume at that instant
  std::size_t n_seen = 0;              ///< number of the instant that `last` is of; from one
  std::uint32_t rows_seen = 0;  ///< one bit for each row that `last` or `before` hold anything of

  PeakTile(int first_row, int first_col) : row0(first_row), col0(first_col) {}
};

/// Every tile that was ever touched.
class PeakTiles {
 public:
  void cover(const Window& w) { directory_.cover(w); }
  /// The tile, made where there was none; inside what `cover` made room for.
  PeakTile& at(int tile_row, int tile_col) {
    std::int32_t& number = directory_.at(tile_row, tile_col);
    if (number < 0) {
      number = static_cast<std::int32_t>(tiles_.size());
      tiles_.emplace_back(tile_row * PeakTile::edge, tile_col * PeakTile::edge);
    }
    return tiles_[static_cast<std::size_t>(number)];
  }
  const std::deque<PeakTile>& tiles() const { return tiles_; }
  std::deque<PeakTile>& tiles() { return tiles_; }
  /// The least part of the grid that holds every cell of some thickness.
  Window window() const;

 private:
  TileDirectory directory_;
  std::deque<PeakTile> tiles_;
};

}  // namespace sturz
