// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/path_distance.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace sturz {

PathDistance::PathDistance(const std::vector<Vec2>& thalweg, Vec2 origin)
    : origin_(std::move(origin)) {
  for (const Vec2& p : thalweg)
    if (corners_.empty() || p != corners_.back()) corners_.push_back(p);
  if (corners_.size() < 2) corners_.clear();
  double length = 0;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    if (i > 0) length += (corners_[i] - corners_[i - 1]).norm();
    before_.push_back(length);
  }
}

double PathDistance::at(const Vec2& place) const {
  if (corners_.empty()) return (place - origin_).norm();
  double nearest = std::numeric_limits<double>::infinity(), along = 0;
  for (std::size_t i = 0; i + 1 < corners_.size(); ++i) {
    const Vec2 side = corners_[i + 1] - corners_[i], to = place - corners_[i];
    double t = to.dot(side) / side.squaredNorm();
    if (i > 0) t = std::max(t, 0.0);
    if (i + 2 < corners_.size()) t = std::min(t, 1.0);
    const double distance2 = (to - t * side).squaredNorm();
    if (distance2 < nearest) nearest = distance2, along = before_[i] + t * side.norm();
  }
  return along;
}

CellDistances::CellDistances(const PathDistance& path, const Grid& maps, const Window& known)
    : path_(path), maps_(maps), known_(known), values_(grid_of(known, maps)) {
  for (int r = 0; r < known.n_rows; ++r)
    for (int c = 0; c < known.n_cols; ++c)
      values_.at(r, c) = path.at({maps.x_center(known.col0 + c), maps.y_center(known.row0 + r)});
}

}  // namespace sturz
