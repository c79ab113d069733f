// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/bed/excavation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace sturz {

Terrain excavate(const Terrain& ground, const Raster<double>& thickness, const Grid& whole) {
  const Grid& g = ground.grid();
  const int factor = static_cast<int>(std::lround(g.cell_m / thickness.grid.cell_m));
  const Window at = window_of(thickness.grid, whole);
  /// Mean over a cell of the ground.
  const auto mean = [&](int row, int col) {
    if (factor <= 1) return thickness.at(row - at.row0, col - at.col0);
    double sum = 0;
    for (int r = row * factor; r < (row + 1) * factor; ++r)
      for (int c = col * factor; c < (col + 1) * factor; ++c)
        if (at.contains(r, c)) sum += thickness.at(r - at.row0, c - at.col0);
    return sum / (factor * factor);
  };
  const int f = std::max(factor, 1);
  const Window near = window_between(at.row0 / f, (at.end_row() - 1) / f + 1, at.col0 / f,
                                     (at.end_col() - 1) / f + 1, g);
  Window dug;
  for (int r = near.row0; r < near.end_row(); ++r)
    for (int c = near.col0; c < near.end_col(); ++c)
      if (mean(r, c) > 0) dug = joined(dug, {r, c, 1, 1});
  if (dug.n_cells() == 0) return ground;
  std::vector<double> patch;
  for (int r = dug.row0; r < dug.end_row(); ++r)
    for (int c = dug.col0; c < dug.end_col(); ++c) {
      const double h = mean(r, c);
      patch.push_back(h > 0 ? ground.node(r, c) - h : nan_d);
    }
  return ground.with_patch(dug.row0, dug.col0, dug.n_rows, dug.n_cols, std::move(patch));
}

}  // namespace sturz
