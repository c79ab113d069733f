// SPDX-License-Identifier: Apache-2.0
/// Exact share of every cell that polygons cover, so that no source loses or gains volume.
///
/// Each edge adds, row by row, the signed area between itself and the eastern edge of the grid; a
/// running sum along the row turns these into cell shares. Holes count negative. The sum over all
/// cells is the polygon's area to round-off (a cell-centre test is off by per cents).
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"

#include <span>
#include <vector>

namespace sturz {

/// Signed area of a closed ring [m2], positive counter-clockwise. The last point may repeat the
/// first or not.
double ring_area(std::span<const Vec2> ring);

/// The cells of a grid that a box touches, one more on every side; empty where it lies beyond.
Window cells_under(double west, double east, double south, double north, const Grid& grid);

class PolygonCover {
 public:
  explicit PolygonCover(const Grid& grid) : PolygonCover(grid, whole_of(grid)) {}
  /// The same for a part of the grid, which must hold all rings as far as they lie on the grid.
  /// Counted from the corner of the whole grid, so that every cell gets the same bits.
  PolygonCover(Grid grid, const Window& window);

  /// Adds `weight` times the share of each cell inside the ring, whatever its orientation.
  /// Holes: the negative weight of their polygon. Rings must not cross themselves; what lies
  /// outside the grid is pushed onto its edge, so check the extent before.
  void add_ring(std::span<const Vec2> ring, double weight);

  /// Sum of all rings so far: shares 0..1 for weight 1, or thickness for weights in metres. On the
  /// grid of the window.
  Raster<double> finish() const;

 private:
  void add_edge(double u0, double v0, double u1, double v1, double weight);
  void add_in_row(int row, double u0, double u1, double dv);

  Grid grid_;
  Window window_;
  std::vector<double>
      steps_;  ///< [window's rows][its columns + 1], change of the share from cell to cell
  double largest_weight_ = 0;
};

}  // namespace sturz
