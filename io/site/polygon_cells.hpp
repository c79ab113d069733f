// SPDX-License-Identifier: Apache-2.0
/// The cells whose centre lies inside polygons: what a value per cell needs, where a share does not
/// help.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"

#include <cstddef>
#include <map>
#include <span>
#include <vector>

namespace sturz {

/// Collects where rings cross the lines through the cells' centres, row by row. Of two polygons
/// that share an edge exactly one has a centre that lies on it.
class PolygonCells {
 public:
  explicit PolygonCells(const Grid& grid) : PolygonCells(grid, whole_of(grid)) {}
  /// Lists the cells of a window only; all are counted.
  PolygonCells(const Grid& grid, const Window& window);

  /// Outer rings and holes alike, in any orientation: inside is where an odd number of them lies
  /// around the centre. What lies outside the grid is left out.
  void add_ring(std::span<const Vec2> ring);

  /// Indices on the window's grid of the cells inside, rising.
  std::vector<std::size_t> finish();
  /// Cells inside on the whole grid; known after finish().
  std::size_t count() const { return count_; }

 private:
  void add_edge(const Vec2& south, const Vec2& north);
  /// The first column whose centre lies at x or east of it; n_cols when there is none.
  int first_column(double x) const;

  Grid grid_;
  Window window_;
  std::map<int, std::vector<double>> crossings_;  ///< per row that has any, x in metres
  std::size_t count_ = 0;
};

}  // namespace sturz
