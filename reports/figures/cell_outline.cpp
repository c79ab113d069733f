// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/cell_outline.hpp"

namespace sturz {
namespace {

/// Calls line(from, to) for every run of neighbours 0 .. n - 1 that are borders.
template <class IsBorder, class Line>
void runs(int n, IsBorder is_border, Line line) {
  int from = -1;
  for (int i = 0; i <= n; ++i) {
    const bool border = i < n && is_border(i);
    if (border && from < 0) from = i;
    if (!border && from >= 0) line(from, i), from = -1;
  }
}

}  // namespace

std::vector<MapLine> cell_outline(const Raster<std::uint8_t>& cells) {
  const Grid& g = cells.grid;
  const auto set = [&](int row, int col) {
    return row >= 0 && col >= 0 && row < g.n_rows && col < g.n_cols && cells.at(row, col) != 0;
  };
  const auto x = [&](int col) { return g.west_m + col * g.cell_m; };
  const auto y = [&](int row) { return g.north_m - row * g.cell_m; };
  std::vector<MapLine> lines;
  for (int row = 0; row <= g.n_rows; ++row)
    runs(
        g.n_cols, [&](int col) { return set(row - 1, col) != set(row, col); },
        [&](int from, int to) {
          lines.push_back({x(from), y(row), x(to), y(row)});
        });
  for (int col = 0; col <= g.n_cols; ++col)
    runs(
        g.n_rows, [&](int row) { return set(row, col - 1) != set(row, col); },
        [&](int from, int to) {
          lines.push_back({x(col), y(from), x(col), y(to)});
        });
  return lines;
}

}  // namespace sturz
