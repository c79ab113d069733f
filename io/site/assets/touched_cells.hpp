// SPDX-License-Identifier: Apache-2.0
/// Which cells of a grid a point or a line touches.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace sturz {

/// Collects cells. A cell holds its western and its northern edge, as Grid::col_of and row_of have
/// it, so that of two cells that share an edge one is touched by what lies on it.
class TouchedCells {
 public:
  explicit TouchedCells(Grid grid) : grid_(std::move(grid)) {}

  void add_point(const Vec2& p);
  /// Every cell that the line through these corners passes.
  void add_line(std::span<const Vec2> corners);
  void add_cell(std::size_t cell) { cells_.push_back(cell); }
  /// Something lay beyond the grid.
  void mark_beyond() { beyond_ = true; }

  /// Indices on the grid, rising, each once.
  std::vector<std::size_t> finish();
  bool beyond() const { return beyond_; }

 private:
  void add_segment(const Vec2& a, const Vec2& b);
  bool holds(const Vec2& p) const;

  Grid grid_;
  std::vector<std::size_t> cells_;
  bool beyond_ = false;
};

}  // namespace sturz
