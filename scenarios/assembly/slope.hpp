// SPDX-License-Identifier: Apache-2.0
/// Slope of a raster of elevations at its cells.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"

#include <cmath>

namespace sturz {

/// Where the cells of a part lie on a larger grid of the same cells.
struct PlaceOnGrid {
  int row = 0, col = 0;  ///< of the part's first cell
  PlaceOnGrid(const Grid& part, const Grid& whole)
      : row(static_cast<int>(std::lround((whole.north_m - part.north_m) / whole.cell_m))),
        col(static_cast<int>(std::lround((part.west_m - whole.west_m) / whole.cell_m))) {}
};

/// Gradient (east, north) [m/m] of the plane that fits the known cells among the 3 x 3 around a
/// cell best; 0 along a direction that they do not tell.
inline Vec2 gradient_at(const Raster<double>& z, int row, int col) {
  const Grid& g = z.grid;
  double n = 0, sx = 0, sy = 0, sz = 0, sxx = 0, sxy = 0, syy = 0, sxz = 0, syz = 0;
  for (int r = row - 1; r <= row + 1; ++r)
    for (int c = col - 1; c <= col + 1; ++c) {
      if (r < 0 || c < 0 || r >= g.n_rows || c >= g.n_cols || !std::isfinite(z.at(r, c))) continue;
      const double x = c - col, y = row - r, dz = z.at(r, c) - z.at(row, col);
      n += 1, sx += x, sy += y, sz += dz;
      sxx += x * x, sxy += x * y, syy += y * y, sxz += x * dz, syz += y * dz;
    }
  if (n < 2 || !std::isfinite(sz)) return {0, 0};
  const double axx = sxx - sx * sx / n, axy = sxy - sx * sy / n, ayy = syy - sy * sy / n;
  const double bx = sxz - sx * sz / n, by = syz - sy * sz / n;
  const double det = axx * ayy - axy * axy;
  if (det > 1e-9) return Vec2(bx * ayy - by * axy, by * axx - bx * axy) / (det * g.cell_m);
  if (axx > 1e-9) return {bx / axx / g.cell_m, 0};
  if (ayy > 1e-9) return {0, by / ayy / g.cell_m};
  return {0, 0};
}

}  // namespace sturz
