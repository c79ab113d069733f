// SPDX-License-Identifier: Apache-2.0
#include "io/site/release_hash.hpp"

#include "io/files/sha256.hpp"

#include <array>
#include <cmath>
#include <span>

namespace sturz {

/// Cells in the order of the grid, each with its place, so that a window's own counting of rows and
/// columns does not enter.
std::string hash_of_release(const SceneInputs& in) {
  const Raster<double>&ground = *in.elevation, &release = *in.release;
  const Window at = window_of(release.grid, in.whole), held = in.held();
  const Grid& g = in.whole;
  Sha256 hash;
  for (int r = 0; r < at.n_rows; ++r)
    for (int c = 0; c < at.n_cols; ++c) {
      if (!(release.at(r, c) > 0)) continue;
      const int row = at.row0 + r, col = at.col0 + c;
      const std::array<double, 4> cell{std::round((g.x_center(col)) / g.cell_m * 1024),
                                       std::round((g.y_center(row)) / g.cell_m * 1024),
                                       ground.at(row - held.row0, col - held.col0),
                                       release.at(r, c)};
      hash.add_values(std::span<const double>(cell));
    }
  return "sha256:" + hash.hex();
}

}  // namespace sturz
