// SPDX-License-Identifier: Apache-2.0
/// How steep and how curved the ground can be around a point: what tells whether the tangent plane
/// below a particle is good enough, or whether a cliff beside it may be nearer.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sturz {

/// Bounds for a block of four nodes and its eight neighbours (all that lies within one cell).
struct SurfaceBound {
  float curvature_per_m =
      0;                   ///< greatest curvature [1/m]; infinite where a slope exceeds 45 degrees
  float min_normal_z = 1;  ///< least n_z: height above ground * this <= distance to the ground
};

/// The rougher of two.
SurfaceBound rougher(SurfaceBound a, SurfaceBound b);

/// Bounds of every block of a window of nodes. NaN nodes and nodes beyond the window are ignored.
/// \param nodes elevations [n_rows][n_cols], row 0 in the north [m]
/// \return [n_rows][n_cols] at the block's north-west node; last row and column are smooth fillers
std::vector<SurfaceBound> surface_bounds(std::span<const double> nodes, int n_rows, int n_cols,
                                         double cell_m);

}  // namespace sturz
