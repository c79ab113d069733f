// SPDX-License-Identifier: Apache-2.0
/// Where a map may say 0: the ground is known there.
#pragma once

#include "engine/terrain/raster.hpp"

#include <cmath>

namespace sturz {

/// Elevations seen from the cells of another grid.
class KnownGround {
 public:
  /// \param elevation null: known everywhere; it and `grid` must outlive this
  /// \param whole of which `elevation` is a window: places are sought on it, so that every window
  ///   gives the same answer; empty: elevation is all of it
  KnownGround(const Raster<double>* elevation, const Grid& whole, const Grid& grid)
      : elevation_(elevation), grid_(grid) {
    if (elevation == nullptr) return;
    whole_ = whole.n_cols > 0 ? whole : elevation->grid;
    held_ = window_of(elevation->grid, whole_);
  }

  /// False where the elevations have a hole at the cell's centre, and beyond the raster. Elevations
  /// at hand must hold all of the map that lies on it: what they do not hold counts as known.
  bool at(int row, int col) const {
    if (elevation_ == nullptr) return true;
    const int r = whole_.row_of(grid_.y_center(row)), c = whole_.col_of(grid_.x_center(col));
    if (r < 0 || c < 0 || r >= whole_.n_rows || c >= whole_.n_cols) return false;
    return !held_.contains(r, c) || std::isfinite(elevation_->at(r - held_.row0, c - held_.col0));
  }

 private:
  const Raster<double>* elevation_;
  const Grid& grid_;
  Grid whole_;
  Window held_;
};

}  // namespace sturz
