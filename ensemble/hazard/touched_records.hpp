// SPDX-License-Identifier: Apache-2.0
/// The store behind MemberCells: touches of cells, taken in member by member, given out cell by
/// cell.
#pragma once

#include "engine/simulation/touched_cells.hpp"
#include "ensemble/hazard/member_cells.hpp"

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace sturz {

/// Goes over an extent in passes. A pass takes as many of the next blocks as will fit by the
/// windows of the members, and gives up those at its end, for the next pass, when what it holds
/// grows beyond the bound all the same.
class TouchedRecords {
 public:
  /// \param windows of the members that will be added, in any order
  TouchedRecords(const Window& extent, std::vector<PeakLayer> layers, std::size_t memory_bytes,
                 std::span<const Window> windows);

  /// Forgets the last pass and begins the next; false when all cells have been handed out.
  bool next_pass();
  /// Cells that this pass may still take; a member need not be read beyond.
  Window cells_ahead() const;
  /// Takes the touched cells that belong to this pass. Members come in ascending order.
  /// \param cells with values of all layers
  void add(std::uint32_t member, const TouchedCells& cells);
  /// The pass's rows, in order.
  void hand_out(const std::function<void(const CellRows&)>& visitor);

 private:
  /// Neighbours in one row of a block.
  struct Piece {
    std::uint32_t member = 0;
    std::uint16_t cell = 0;  // the first, of the whole block, row by row
    std::uint16_t n = 0;
  };
  /// Touches within one block of cells. Values stay where they were put: a vector that grew would
  /// copy each of them several times.
  struct Block {
    std::vector<Piece> pieces;
    std::vector<std::unique_ptr<float[]>> chunks;  // of piece after piece, [layer][cell]
    std::size_t left = 0;                          // in the last chunk
    std::size_t touches = 0;
  };
  // Rows of blocks, counted through: row r of block b is b * block_edge + r. The window of a block
  // at the southern edge has fewer; those rows are empty.
  using RowCount = std::int64_t;

  Window block_window(std::size_t block) const;
  std::size_t bytes_of(const Block& block) const;
  /// Room for values of one piece, in one stretch.
  float* room_for(Block& block, std::size_t n);
  /// Calls `use(piece, its values)` in the order in which they were put.
  template <class Use>
  void each_piece(const Block& block, const Use& use) const;
  void put(Block& to, const Piece& piece, const TouchedCells& from, std::size_t first);
  RowCount planned_end() const;
  void make_room();
  void keep_rows_below(Block& block, int row);
  void hand_out(std::size_t block, int first_row, int end_row,
                const std::function<void(const CellRows&)>& visitor);
  void order_by_row(const Block& from);
  void sort(const Window& block, int first_row, int end_row);

  Window extent_;
  std::vector<PeakLayer> layers_;
  std::size_t memory_bytes_;
  std::size_t chunk_ = 0;  // floats
  std::size_t n_block_cols_ = 0, n_blocks_ = 0;
  std::vector<double> bounds_;    // of each block: cells of members' windows
  double filled_ = 1;             // share of them that the last pass held
  RowCount first_ = 0, end_ = 0;  // of this pass
  std::size_t first_block_ = 0;
  std::vector<Block> blocks_;  // of this pass, from first_block_
  std::size_t bytes_ = 0;

  // Scratch of hand_out.
  struct Placed {
    Piece piece;
    const float* values = nullptr;
  };
  std::vector<Placed> by_row_;
  std::array<std::size_t, MemberCells::block_edge + 1> row_begin_{};  // in by_row_
  CellRows rows_;
  std::vector<std::uint32_t> next_;
};

}  // namespace sturz
