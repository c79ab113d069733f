// SPDX-License-Identifier: Apache-2.0
// What lies under the particles themselves, without the width that they are spread over.
#include "engine/simulation/maps/eight.hpp"
#include "engine/simulation/peak_maps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sturz {

/// Covers the cells whose centre lies under the particle itself, and the one that it is in.
void PeakMaps::cover_cell_of(double x, double y, double half_width, SumTiles& to) const {
  const Grid& g = settings_.grid;
  const int row0 = std::max(0, static_cast<int>(std::ceil(y - half_width)));
  const int col0 = std::max(0, static_cast<int>(std::ceil(x - half_width)));
  const int row1 = std::min(g.n_rows, static_cast<int>(std::ceil(y + half_width)));
  const int col1 = std::min(g.n_cols, static_cast<int>(std::ceil(x + half_width)));
  constexpr int edge = SumTiles::edge;
  for (int row = row0; row < row1; ++row)
    for (int col = col0; col < col1; ++col)
      to.under(to.slot_at(row / edge, col / edge))[row % edge * edge + col % edge] += enough_under;
}

/// Covers what lies under a square around a place, both in cells from the centre of cell 0; no
/// more than the particle is spread over.
void PeakMaps::cover_square(double x, double y, double side, SumTiles& to) const {
  constexpr int edge = SumTiles::edge;
  const Grid& g = settings_.grid;
  const double west = x + 0.5 - 0.5 * side, north = y + 0.5 - 0.5 * side;
  const int row0 = std::max({0, down_.first(), static_cast<int>(std::floor(north))});
  const int col0 = std::max({0, across_.first(), static_cast<int>(std::floor(west))});
  const int row1 =
      std::min({g.n_rows, down_.first() + down_.n(), static_cast<int>(std::ceil(north + side))});
  const int col1 =
      std::min({g.n_cols, across_.first() + across_.n(), static_cast<int>(std::ceil(west + side))});
  if (row0 >= row1 || col0 >= col1) return;
  const Eight steps = {0, 1, 2, 3, 4, 5, 6, 7}, none{};
  const auto length = static_cast<float>(side);
  for (int first = col0 / 8 * 8; first < col1; first += 8) {      // never across the edge of a tile
    const Eight from = steps + static_cast<float>(first - west);  // of each cell, from the square's
    const Eight end = smaller(from + 1.0F, none + length);
    const Eight wide = larger(end - larger(from, none), none);
    for (int row = row0; row < row1; ++row) {
      const auto high =
          static_cast<float>(std::min(row + 1.0, north + side) - std::max<double>(row, north));
      float* under = to.under(to.slot_at(row / edge, first / edge)) +
                     std::ptrdiff_t{edge} * (row % edge) + first % edge;
      put_eight(under, eight_at(under) + high * wide);
    }
  }
}

}  // namespace sturz
