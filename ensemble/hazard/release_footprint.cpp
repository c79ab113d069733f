// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/release_footprint.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace sturz {
namespace {

/// Row and column of every cell that flow covers at once.
using Cells = std::set<std::pair<int, int>>;

void add_covered(const MemberSource& members, std::size_t index, Cells& cells) {
  const Window& w = members.members()[index].window;
  std::vector<float> row(static_cast<std::size_t>(members.grid().n_cols));
  for (int r = w.row0; r < w.row0 + w.n_rows; ++r) {
    members.read_rows(index, PeakLayer::arrival, r, 1, row);
    for (int c = w.col0; c < w.col0 + w.n_cols; ++c)
      if (row[static_cast<std::size_t>(c)] == 0) cells.emplace(r, c);
  }
}

}  // namespace

Raster<std::uint8_t> release_footprint(const MemberSource& members, int n_looked_at) {
  Cells cells;
  for (std::size_t i = 0; i < members.members().size() && n_looked_at > 0; ++i) {
    if (!is_valid(members.members()[i].outcome)) continue;
    add_covered(members, i, cells);
    --n_looked_at;
  }
  if (cells.empty()) return {};
  int col0 = cells.begin()->second, col1 = col0;
  for (const auto& [row, col] : cells) col0 = std::min(col0, col), col1 = std::max(col1, col);
  const int row0 = cells.begin()->first, row1 = cells.rbegin()->first;
  const Grid& g = members.grid();
  Grid part = g;
  part.n_rows = row1 - row0 + 1, part.n_cols = col1 - col0 + 1;
  part.west_m = g.west_m + col0 * g.cell_m;
  part.north_m = g.north_m - row0 * g.cell_m;
  Raster<std::uint8_t> covered(part);
  for (const auto& [row, col] : cells) covered.at(row - row0, col - col0) = 1;
  return covered;
}

}  // namespace sturz
