// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/covered_cells.hpp"

#include <vector>

namespace sturz {

bool Exceedance::is_arrival() const {
  return layer == PeakLayer::arrival || layer == PeakLayer::solid_arrival ||
         layer == PeakLayer::liquid_arrival;
}

Raster<std::uint8_t> covered_cells(const MemberParts& source, std::size_t index,
                                   const Exceedance& what, const Window& extent) {
  Raster<std::uint8_t> covered(grid_of(extent, source.grid()), 0);
  const Window part = overlap(source.members()[index].window, extent);
  std::vector<float> values(part.n_cells());
  if (values.empty()) return covered;
  source.read_part(index, what.layer, part, values);
  for (int row = 0; row < part.n_rows; ++row)
    for (int col = 0; col < part.n_cols; ++col)
      covered.at(part.row0 + row - extent.row0, part.col0 + col - extent.col0) =
          what.holds(values[static_cast<std::size_t>(row) * part.n_cols + col]) ? 1 : 0;
  return covered;
}

}  // namespace sturz
