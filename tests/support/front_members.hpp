// SPDX-License-Identifier: Apache-2.0
/// Members whose flow is a strip that ends in a straight front.
#pragma once

#include "tests/support/memory_members.hpp"

#include <cstdint>

namespace sturz::test {

/// The flow lies west of the front and is as thick as it is far behind it, over 100.
/// \param front_m from the grid's western edge
inline MemberResult front_member(std::int64_t number, double front_m, const Grid& grid) {
  MemberResult m;
  m.member = number;
  m.outcome = Outcome::settled;
  m.grid = grid;
  m.window = whole_of(grid);
  for (const PeakLayer layer : {PeakLayer::thickness, PeakLayer::arrival})
    m.layers[static_cast<std::size_t>(layer)].assign(m.window.n_cells(), info(layer).untouched);
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col) {
      const double behind = front_m - grid.cell_m * (col + 0.5);
      if (!(behind > 0)) continue;
      m.layer(PeakLayer::thickness)[grid.index(row, col)] = static_cast<float>(behind / 100);
      m.layer(PeakLayer::arrival)[grid.index(row, col)] = 1;
    }
  return m;
}

}  // namespace sturz::test
