// SPDX-License-Identifier: Apache-2.0
/// The cells whose centre lies inside polygons: what a value per cell needs, where a share does not
/// help.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace sturz {

/// Collects where rings cross the lines through the cells' centres, row by row. Of two polygons
/// that share an edge exactly one has a centre that lies on it.
class PolygonCells {
 public:
  explicit PolygonCells(const Grid& grid);

  /// Outer rings and holes alike, in any orientation: inside is where an odd number of them lies
  /// around the centre. What lies outside the grid is left out.
  void add_ring(std::span<const Vec2> ring);

  /// Indices of the cells inside, rising.
  std::vector<std::size_t> finish();

 private:
  void add_edge(const Vec2& south, const Vec2& north);
  /// The first column whose centre lies at x or east of it; n_cols when there is none.
  int first_column(double x) const;

  Grid grid_;
  std::vector<std::vector<double>> crossings_;  ///< per row, x in metres
};

}  // namespace sturz
