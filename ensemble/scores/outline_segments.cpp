// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/outline_segments.hpp"

#include <utility>

namespace sturz {
namespace {

/// Adds a segment for every run of neighbours 0 .. n - 1 that are borders.
template <class IsBorder, class Point>
void add_runs(int n, IsBorder is_border, Point point, std::vector<Segment>& to) {
  int from = -1;
  for (int i = 0; i <= n; ++i) {
    const bool border = i < n && is_border(i);
    if (border && from < 0) from = i;
    if (!border && from >= 0) to.push_back({point(from), point(i)}), from = -1;
  }
}

}  // namespace

Raster<std::uint8_t> without_holes(Raster<std::uint8_t> cells) {
  // One more cell on every side, so that the outside hangs together.
  const int rows = cells.grid.n_rows + 2, cols = cells.grid.n_cols + 2;
  std::vector<std::uint8_t> outside(static_cast<std::size_t>(rows) * cols, 0);
  const auto is_set = [&](int r, int c) {
    return cells.grid.contains(r - 1, c - 1) && cells.at(r - 1, c - 1) != 0;
  };
  std::vector<std::pair<int, int>> front{{0, 0}};
  outside[0] = 1;
  while (!front.empty()) {
    const auto [row, col] = front.back();
    front.pop_back();
    for (const auto& [dr, dc] :
         {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)}) {
      const int r = row + dr, c = col + dc;
      if (r < 0 || c < 0 || r >= rows || c >= cols || is_set(r, c)) continue;
      std::uint8_t& seen = outside[static_cast<std::size_t>(r) * cols + c];
      if (seen == 0) seen = 1, front.emplace_back(r, c);
    }
  }
  for (int r = 0; r < cells.grid.n_rows; ++r)
    for (int c = 0; c < cells.grid.n_cols; ++c)
      if (outside[static_cast<std::size_t>(r + 1) * cols + c + 1] == 0) cells.at(r, c) = 1;
  return cells;
}

std::vector<Segment> outer_boundary(const Raster<std::uint8_t>& cells) {
  const Raster<std::uint8_t> filled = without_holes(cells);
  const Grid& g = filled.grid;
  const auto set = [&](int row, int col) {
    return g.contains(row, col) && filled.at(row, col) != 0;
  };
  const auto corner = [&](int row, int col) {
    return Vec2(g.west_m + col * g.cell_m, g.north_m - row * g.cell_m);
  };
  std::vector<Segment> segments;
  for (int row = 0; row <= g.n_rows; ++row)
    add_runs(
        g.n_cols, [&](int col) { return set(row - 1, col) != set(row, col); },
        [&](int col) { return corner(row, col); }, segments);
  for (int col = 0; col <= g.n_cols; ++col)
    add_runs(
        g.n_rows, [&](int row) { return set(row, col - 1) != set(row, col); },
        [&](int row) { return corner(row, col); }, segments);
  return segments;
}

std::vector<Segment> sides_of(const std::vector<std::vector<Vec2>>& rings) {
  std::vector<Segment> sides;
  for (const auto& ring : rings)
    for (std::size_t i = 1; i < ring.size(); ++i)
      if (ring[i] != ring[i - 1]) sides.push_back({ring[i - 1], ring[i]});
  return sides;
}

}  // namespace sturz
