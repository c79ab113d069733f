// SPDX-License-Identifier: Apache-2.0
/// Reads the valid members of an ensemble tile by tile, cell by cell, within a memory bound.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sturz {

/// One layer of a tile of cells, of all valid members in ascending order of their number. Kept as
/// read, [member][cell]; cells are handed out one by one, turned in groups that fit the cache.
class CellBlock {
 public:
  const Window& tile() const { return tile_; }
  /// Makes room for a tile. Old values and cells are gone.
  void reset(const Window& tile, std::size_t n_members, float fill);
  /// The tile of one member, row by row, for writing.
  std::span<float> member(std::size_t m) { return {&values_[m * n_cells_], n_cells_}; }
  /// Values of all members in cell i of the tile, [n_members]. Valid until the next call; quick
  /// when i ascends.
  std::span<const float> cell(std::size_t i);

 private:
  static constexpr std::size_t group_size = 16;  // floats in a cache line

  Window tile_;
  std::size_t n_cells_ = 0, n_members_ = 0;
  std::vector<float> values_;
  std::vector<float> group_;  // [group_size][n_members]
  std::size_t group_begin_ = 0, group_end_ = 0;
};

/// The valid members of a source in ascending order of their number, whatever the order of the
/// source, and the cells that any of them touched. Statistics made from it are functions of the
/// set of members alone: shards, resume and tile sizes leave no trace.
class MemberTiles {
 public:
  /// \param memory_limit_bytes bound on what `blocks_at_once` blocks hold together
  /// \throws SetupError if a member number occurs twice
  MemberTiles(const MemberSource& source, std::size_t memory_limit_bytes, int blocks_at_once);

  std::size_t n_members() const { return indices_.size(); }
  /// Smallest rectangle around all touched cells; empty when none is.
  const Window& touched() const { return touched_; }
  /// Disjoint windows that cover touched(). One row and one column are the least a tile can be.
  const std::vector<Window>& tiles() const { return tiles_; }
  /// One layer of one tile. Reuses the block's memory.
  /// \throws SetupError naming the member if a peak is negative or not a number, or an arrival
  ///         time is negative
  void read(PeakLayer layer, const Window& tile, CellBlock& block) const;

 private:
  const MemberSource& source_;
  std::vector<std::size_t> indices_;  // into source_.members()
  Window touched_;
  std::vector<Window> tiles_;
  mutable std::vector<float> rows_;
};

}  // namespace sturz
