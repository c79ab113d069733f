// SPDX-License-Identifier: Apache-2.0
/// How far down the path a place lies: along a thalweg, or straight from the source.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"

#include <vector>

namespace sturz {

/// Along a thalweg it is that of the nearest point on it; the line goes on straight beyond both
/// ends, so that who ran farther is not cut off there, and distances before its start are below 0.
class PathDistance {
 public:
  /// \param thalweg corners down the path; fewer than two: straight from `origin`
  PathDistance(const std::vector<Vec2>& thalweg, Vec2 origin);

  bool along_thalweg() const { return !corners_.empty(); }
  double at(const Vec2& place) const;

 private:
  std::vector<Vec2> corners_;   ///< without repetitions
  std::vector<double> before_;  ///< length up to each corner
  Vec2 origin_;
};

/// The same for the cells of a window, worked out once.
class CellDistances {
 public:
  CellDistances(const PathDistance& path, const Grid& maps, const Window& known);
  double at(int row, int col) const {
    if (known_.contains(row, col)) return values_.at(row - known_.row0, col - known_.col0);
    return path_.at({maps_.x_center(col), maps_.y_center(row)});
  }

 private:
  PathDistance path_;
  Grid maps_;
  Window known_;
  Raster<double> values_;
};

}  // namespace sturz
