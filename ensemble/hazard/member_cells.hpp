// SPDX-License-Identifier: Apache-2.0
/// What the valid members of an ensemble left in each cell, block by block, within a memory bound.
///
/// Members lie on disk member by member; statistics want them cell by cell. A pass opens every
/// member once and keeps what it left in the next cells, as many as the memory holds: with a few
/// hundred members that is all of them. Cells are handed out in one order, blocks from the
/// north-west and rows within them, whatever the memory: nothing that is made from them can depend
/// on it.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/simulation/member_parts.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sturz {

/// Whole rows of one block of cells. Cell i is that of row i / n_cols of the window.
struct CellRows {
  Window window;  ///< in the grid
  Window block;   ///< the block whose rows these are
  /// Touches of cell i are [begin[i], begin[i + 1]) in all columns below, by ascending member.
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> members;  ///< place of the member among the valid ones
  std::array<std::vector<float>, n_peak_layers> values;  ///< empty for layers not asked for
  /// Of each cell's values, added up in the order of the members.
  std::array<std::vector<double>, n_peak_layers> sums;

  bool completes_block() const { return end_row(window) == end_row(block); }
  std::span<const std::uint32_t> members_of(std::size_t i) const {
    return {members.data() + begin[i], begin[i + 1] - begin[i]};
  }
  std::span<const float> of(PeakLayer layer, std::size_t i) const {
    return {values[static_cast<std::size_t>(layer)].data() + begin[i], begin[i + 1] - begin[i]};
  }
};

class MemberCells {
 public:
  static constexpr int block_edge = 128;  ///< cells
  static constexpr std::size_t default_memory_bytes = std::size_t{128} << 20;

  /// \throws SetupError if a member number occurs twice
  explicit MemberCells(const MemberParts& source);

  std::size_t n_members() const { return indices_.size(); }
  /// Smallest rectangle around the windows of all valid members; empty when none moved.
  const Window& touched() const { return touched_; }

  /// Hands out every cell of `extent` once, untouched ones too. A cell counts as touched by a
  /// member that left another value than that of an untouched cell in one of `layers`. \param
  /// memory_bytes bound on what members' values take; a row of a block is the least \throws
  /// SetupError naming the member if a peak is negative or not a number, or an arrival time
  ///         is negative; Cancelled
  void visit(const Window& extent, const std::vector<PeakLayer>& layers, std::size_t memory_bytes,
             CancelFlag cancel, const std::function<void(const CellRows&)>& visitor) const;

 private:
  const MemberParts& source_;
  std::vector<std::size_t> indices_;  // into source_.members(), ascending by member number
  Window touched_;
};

}  // namespace sturz
