// SPDX-License-Identifier: Apache-2.0
/// Which zone of the bed a map point lies in.
#pragma once

#include "engine/terrain/raster.hpp"

#include <cstdint>
#include <memory>

namespace sturz {

/// Shared, read-only; without a raster the whole ground is zone 0.
struct ZoneMap {
  std::shared_ptr<const Raster<std::uint8_t>> zones;
  Grid whole = {};         ///< of which `zones` holds a part; empty: all of it
  int row0 = 0, col0 = 0;  ///< of the part

  bool any() const { return zones != nullptr; }
  /// Zone of the cell that holds (x, y); 0 outside the raster.
  int at(double x, double y) const {
    if (!zones) return 0;
    const Grid& g = whole.n_cols > 0 ? whole : zones->grid;
    const int row = g.row_of(y) - row0, col = g.col_of(x) - col0;
    return zones->grid.contains(row, col) ? zones->at(row, col) : 0;
  }
};

}  // namespace sturz
