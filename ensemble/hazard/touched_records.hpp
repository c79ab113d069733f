// SPDX-License-Identifier: Apache-2.0
/// The store behind MemberCells: touches of cells, taken in member by member, given out cell by
/// cell.
#pragma once

#include "ensemble/hazard/member_cells.hpp"

#include <functional>
#include <vector>

namespace sturz {

/// Goes over an extent in passes. A pass begins with all rows that are still to come and gives up
/// those at its end, for the next pass, whenever what it holds grows beyond the bound.
class TouchedRecords {
 public:
  TouchedRecords(const Window& extent, std::vector<PeakLayer> layers, std::size_t memory_bytes);

  /// Forgets the last pass and begins the next; false when all cells have been handed out.
  bool next_pass();
  /// Cells that this pass may still take; a member need not be read beyond.
  Window rows_ahead() const;
  /// Takes the touched cells of `band` that belong to this pass. Members come in ascending order.
  /// \param values one vector [band.n_cells()] for each layer
  void add(std::uint32_t member, const Window& band, const std::vector<std::vector<float>>& values);
  /// The pass's rows, in order.
  void hand_out(const std::function<void(const CellRows&)>& visitor);

 private:
  /// Touches within one block of cells.
  struct Block {
    std::vector<std::uint32_t> members;
    std::vector<std::uint16_t> cells;  // of the whole block, row by row
    std::vector<float> values;         // [touch][layer]
  };
  // Rows of blocks, counted through: row r of block b is b * block_edge + r. The window of a block
  // at the southern edge has fewer; those rows are empty.
  using RowCount = std::int64_t;

  Window block_window(std::size_t block) const;
  std::size_t bytes_of(const Block& block) const;
  void make_room();
  void keep_rows_below(Block& block, int row) const;
  CellRows sorted(std::size_t block, int first_row, int end_row) const;

  Window extent_;
  std::vector<PeakLayer> layers_;
  std::size_t memory_bytes_;
  std::size_t n_block_cols_ = 0, n_blocks_ = 0;
  RowCount first_ = 0, end_ = 0, next_length_ = 0;  // of this pass
  std::size_t first_block_ = 0;
  std::vector<Block> blocks_;  // of this pass, from first_block_
  std::size_t bytes_ = 0;
};

}  // namespace sturz
