// SPDX-License-Identifier: Apache-2.0
#include "io/site/assets/touched_cells.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Number of the cell along an axis that holds `place` [cells]; -1 and n where it lies outside, so
/// that no coordinate overflows.
int cell_of(double place, int n) {
  return static_cast<int>(std::clamp(std::floor(place), -1.0, static_cast<double>(n)));
}

}  // namespace

bool TouchedCells::holds(const Vec2& p) const {
  const double u = (p.x() - grid_.west_m) / grid_.cell_m;
  const double v = (grid_.north_m - p.y()) / grid_.cell_m;
  return u >= 0 && u < grid_.n_cols && v >= 0 && v < grid_.n_rows;
}

void TouchedCells::add_point(const Vec2& p) {
  if (!holds(p)) return mark_beyond();
  add_cell(grid_.index(cell_of((grid_.north_m - p.y()) / grid_.cell_m, grid_.n_rows),
                       cell_of((p.x() - grid_.west_m) / grid_.cell_m, grid_.n_cols)));
}

void TouchedCells::add_line(std::span<const Vec2> corners) {
  for (const Vec2& p : corners) beyond_ = beyond_ || !holds(p);
  if (corners.size() == 1) add_segment(corners[0], corners[0]);
  for (std::size_t i = 1; i < corners.size(); ++i) add_segment(corners[i - 1], corners[i]);
}

void TouchedCells::add_segment(const Vec2& a, const Vec2& b) {
  // In cells from the north-west corner, from north to south: either direction gives the same.
  const auto place = [&](const Vec2& p) {
    return Vec2((p.x() - grid_.west_m) / grid_.cell_m, (grid_.north_m - p.y()) / grid_.cell_m);
  };
  Vec2 north = place(a), south = place(b);
  if (south.y() < north.y() || (south.y() == north.y() && south.x() < north.x()))
    std::swap(north, south);
  const double fall = south.y() - north.y();
  const auto x_at = [&](double v) {
    if (!(fall > 0)) return north.x();
    const double share = std::clamp((v - north.y()) / fall, 0.0, 1.0);
    return north.x() + share * (south.x() - north.x());
  };
  const int first = std::max(0, cell_of(north.y(), grid_.n_rows));
  const int last = std::min(grid_.n_rows - 1, cell_of(south.y(), grid_.n_rows));
  for (int row = first; row <= last; ++row) {
    const double x0 = fall > 0 ? x_at(row) : north.x(), x1 = fall > 0 ? x_at(row + 1) : south.x();
    const int west = std::max(0, cell_of(std::min(x0, x1), grid_.n_cols));
    const int east = std::min(grid_.n_cols - 1, cell_of(std::max(x0, x1), grid_.n_cols));
    for (int col = west; col <= east; ++col) add_cell(grid_.index(row, col));
  }
}

std::vector<std::size_t> TouchedCells::finish() {
  std::sort(cells_.begin(), cells_.end());
  cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
  return cells_;
}

}  // namespace sturz
