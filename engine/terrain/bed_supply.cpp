// SPDX-License-Identifier: Apache-2.0
#include "engine/terrain/bed_supply.hpp"

#include "engine/core/sum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

/// Index of the same cell within one period of n cells.
int repeated(int k, int n) {
  const int in = k % n;
  return in < 0 ? in + n : in;
}

/// Calls place(k, length) for the cells of a row of them that lie under [from, to], in cells.
template <class Place>
void overlaps(double from, double to, Place&& place) {
  for (int k = static_cast<int>(std::floor(from)); k < to; ++k) {
    const double length = std::min(to, k + 1.0) - std::max(from, static_cast<double>(k));
    if (length > 0) place(k, length);
  }
}

}  // namespace

BedSupply::BedSupply(Grid grid, BedSource source, bool repeats_x, bool repeats_y)
    : grid_(std::move(grid)),
      source_(std::move(source)),
      repeats_x_(repeats_x),
      repeats_y_(repeats_y),
      tiles_across_((grid_.n_cols + edge - 1) / edge) {
  const int tiles_down = (grid_.n_rows + edge - 1) / edge;
  places_.assign(static_cast<std::size_t>(tiles_across_) * static_cast<std::size_t>(tiles_down),
                 -1);
}

BedSupply::Cell* BedSupply::cell(int row, int col) {
  if (repeats_x_) col = repeated(col, grid_.n_cols);
  if (repeats_y_) row = repeated(row, grid_.n_rows);
  if (!grid_.contains(row, col)) return nullptr;
  Tile& tile = open(row / edge, col / edge);
  return &tile.cells[static_cast<std::size_t>(row % edge) * edge +
                     static_cast<std::size_t>(col % edge)];
}

BedSupply::Tile& BedSupply::open(int tile_row, int tile_col) {
  std::int32_t& place =
      places_[static_cast<std::size_t>(tile_row) * static_cast<std::size_t>(tiles_across_) +
              static_cast<std::size_t>(tile_col)];
  if (place >= 0) return tiles_[static_cast<std::size_t>(place)];
  place = static_cast<std::int32_t>(tiles_.size());
  Tile& tile = tiles_.emplace_back();
  tile.row0 = tile_row * edge, tile.col0 = tile_col * edge;
  for (int k = 0; k < edge * edge; ++k) {
    const int row = tile.row0 + k / edge, col = tile.col0 + k % edge;
    if (grid_.contains(row, col))
      tile.cells[static_cast<std::size_t>(k)].left = source_.depth(row, col);
  }
  return tile;
}

double BedSupply::eroded_volume_m3() const {
  Sum depth;
  visit_eroded([&](int, int, double eroded) { depth.add(eroded); });
  return depth.value() * grid_.cell_m * grid_.cell_m;
}

std::vector<float> eroded_depth_on(const BedSupply& bed, const Grid& whole, const Window& part) {
  std::vector<double> depth(part.n_cells());
  const Grid& from = bed.grid();
  const double cells = from.cell_m / whole.cell_m;  // of `whole` along one of the bed
  const double right = (from.west_m - whole.west_m) / whole.cell_m,
               down = (whole.north_m - from.north_m) / whole.cell_m;
  bed.visit_eroded([&](int row, int col, double eroded) {
    overlaps(down + row * cells, down + (row + 1) * cells, [&](int r, double high) {
      overlaps(right + col * cells, right + (col + 1) * cells, [&](int c, double wide) {
        if (part.contains(r, c))
          depth[static_cast<std::size_t>(r - part.row0) * static_cast<std::size_t>(part.n_cols) +
                static_cast<std::size_t>(c - part.col0)] += eroded * high * wide;
      });
    });
  });
  return {depth.begin(), depth.end()};
}

}  // namespace sturz
