// SPDX-License-Identifier: Apache-2.0
/// Where a map may say 0: the ground is known there.
#pragma once

#include "engine/terrain/raster.hpp"

namespace sturz {

/// Elevations seen from the cells of another grid.
class KnownGround {
 public:
  /// \param elevation null: known everywhere; both must outlive it
  KnownGround(const Raster<double>* elevation, const Grid& grid)
      : elevation_(elevation), grid_(grid) {}

  /// False where the elevations have a hole at the cell's centre. Beyond the elevations at hand
  /// nothing is known to be one.
  bool at(int row, int col) const {
    if (elevation_ == nullptr) return true;
    const Grid& of = elevation_->grid;
    const int r = of.row_of(grid_.y_center(row)), c = of.col_of(grid_.x_center(col));
    return !of.contains(r, c) || std::isfinite(elevation_->at(r, c));
  }

 private:
  const Raster<double>* elevation_;
  const Grid& grid_;
};

}  // namespace sturz
