// SPDX-License-Identifier: Apache-2.0
/// A shape's own axes on the map: s downhill, n to the left of it, both from the map's origin.
#pragma once

#include "engine/terrain/raster.hpp"

namespace sturz::shapes {

class Frame {
 public:
  /// \param azimuth_deg direction of +s, clockwise from north; 90 makes s = x and n = y
  explicit Frame(double azimuth_deg);

  double s(double x, double y) const { return x * east_ + y * north_; }
  double n(double x, double y) const { return y * east_ - x * north_; }
  /// Smallest north-up grid over the rectangle s0..s1, n0..n1.
  /// \throws SetupError when it would need more than 1e8 cells
  Grid grid_over(double s0, double s1, double n0, double n1, double cell_m) const;

 private:
  double east_, north_;  ///< unit vector of +s
};

/// North-up grid with its south-west corner at (west, south); sizes are rounded up to whole cells.
Grid grid_from_corner(double west, double south, double width, double height, double cell_m);

/// The last parameter of shapes that can be turned.
inline constexpr const char* azimuth_help = "downhill direction, clockwise from north";

}  // namespace sturz::shapes
