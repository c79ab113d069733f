// SPDX-License-Identifier: Apache-2.0
#include "engine/terrain/held_ground.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace sturz {
namespace {

/// Nodes beyond a block's own on which its bounds depend, rounded up.
constexpr int bound_reach = 2;

/// Nodes of the window whose blocks' bounds are those of the whole raster.
Window usable_nodes(const Window& w, const Grid& g) {
  const int row0 = w.row0 == 0 ? 0 : w.row0 + bound_reach;
  const int col0 = w.col0 == 0 ? 0 : w.col0 + bound_reach;
  const int row1 = w.end_row() == g.n_rows ? g.n_rows : w.end_row() - bound_reach;
  const int col1 = w.end_col() == g.n_cols ? g.n_cols : w.end_col() - bound_reach;
  return {row0, col0, std::max(0, row1 - row0), std::max(0, col1 - col0)};
}

/// Tiles in one direction whose blocks all lie between usable nodes first..end-1.
std::pair<int, int> whole_tiles(int first, int end, int n_nodes) {
  const int tile = HeldGround::tile;
  const int from = (first + tile - 1) / tile;
  const int last_block = end - 2;  // counted by its north-west node
  const int to = end == n_nodes ? last_block / tile + 1 : (last_block + 1) / tile;
  return {from, std::max(0, to - from)};
}

bool has_known_block(const Raster<double>& z) {
  const Grid& g = z.grid;
  for (int r = 0; r + 1 < g.n_rows; ++r)
    for (int c = 0; c + 1 < g.n_cols; ++c)
      if (std::isfinite(z.at(r, c) + z.at(r, c + 1) + z.at(r + 1, c) + z.at(r + 1, c + 1)))
        return true;
  return false;
}

}  // namespace

HeldGround::HeldGround(Grid whole, std::shared_ptr<const Raster<double>> part,
                       std::optional<double> lowest)
    : grid(std::move(whole)), elevation(std::move(part)) {
  expect(elevation != nullptr, "a terrain has an elevation raster");
  const Grid& g = elevation->grid;
  expect(elevation->values.size() == g.n_cells(), "a raster has one value per cell");
  require(grid.n_cols >= 2 && grid.n_rows >= 2,
          "terrain: the elevation raster has " + std::to_string(grid.n_cols) + " x " +
              std::to_string(grid.n_rows) +
              " cells (a surface needs at least 2 x 2). Use a larger raster.");
  require(g.cell_m > 0 && std::isfinite(g.cell_m),
          "terrain: the cell size is not a positive length (surface slopes would be undefined). "
          "Check the raster's geotransform.");
  window = window_of(g, grid);
  expect(whole_of(grid).contains(window), "the part that is held lies on the raster");
  require(has_known_block(*elevation),
          "terrain: no 2 x 2 block of cells has known elevations (all or nearly all is nodata). "
          "Check the raster's nodata value and the area cut out of it.");
  usable = usable_nodes(window, grid);
  lowest_m = std::numeric_limits<double>::infinity();
  for (double z : elevation->values)
    if (std::isfinite(z)) lowest_m = std::min(lowest_m, z);
  if (lowest) lowest_m = *lowest;
  bounds = surface_bounds(elevation->values, g.n_rows, g.n_cols, g.cell_m);
  survey_tiles();
}

void HeldGround::survey_tiles() {
  const auto [row0, n_rows] = whole_tiles(usable.row0, usable.end_row(), grid.n_rows);
  const auto [col0, n_cols] = whole_tiles(usable.col0, usable.end_col(), grid.n_cols);
  tiles = {row0, col0, n_rows, n_cols};
  tile_facts.resize(tiles.n_cells());
  for (int i = 0; i < n_rows; ++i)
    for (int j = 0; j < n_cols; ++j) {
      Tile& facts = tile_facts[static_cast<std::size_t>(i) * n_cols + j];
      const int top = (row0 + i) * tile, left = (col0 + j) * tile;
      const int bottom = std::min(top + tile, grid.n_rows - 1);
      const int right = std::min(left + tile, grid.n_cols - 1);
      for (int r = top; r <= bottom; ++r)
        for (int c = left; c <= right; ++c) {
          const std::size_t k = index(r, c);
          facts.known = facts.known && std::isfinite(elevation->values[k]);
          if (r < bottom && c < right) facts.bound = rougher(facts.bound, bounds[k]);
        }
    }
}

std::optional<HeldGround::Tile> HeldGround::around(int row0, int row1, int col0, int col1) const {
  row0 = std::max(row0, 0) / tile, row1 = std::min(row1, grid.n_rows - 2) / tile;
  col0 = std::max(col0, 0) / tile, col1 = std::min(col1, grid.n_cols - 2) / tile;
  if (!tiles.contains(row0, col0) || !tiles.contains(row1, col1)) return {};
  Tile all;
  for (int i = row0; i <= row1; ++i)
    for (int j = col0; j <= col1; ++j) {
      const Tile& one =
          tile_facts[static_cast<std::size_t>(i - tiles.row0) * tiles.n_cols + (j - tiles.col0)];
      all.bound = rougher(all.bound, one.bound);
      all.known = all.known && one.known;
    }
  return all;
}

}  // namespace sturz
