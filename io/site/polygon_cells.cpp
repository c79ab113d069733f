// SPDX-License-Identifier: Apache-2.0
#include "io/site/polygon_cells.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

PolygonCells::PolygonCells(const Grid& grid, const Window& window) : grid_(grid), window_(window) {}

void PolygonCells::add_ring(std::span<const Vec2> ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    // Always from south to north: two polygons that share an edge cross at the same digits.
    if (a.y() < b.y())
      add_edge(a, b);
    else
      add_edge(b, a);
  }
}

void PolygonCells::add_edge(const Vec2& south, const Vec2& north) {
  const auto row_of = [&](double y) {
    return std::clamp((grid_.north_m - y) / grid_.cell_m, -1.0, grid_.n_rows + 1.0);
  };
  // A row more on both sides; the comparison decides, the same one for every edge that meets there.
  const int first = std::max(0, static_cast<int>(std::floor(row_of(north.y()))) - 1);
  const int last = std::min(grid_.n_rows - 1, static_cast<int>(std::floor(row_of(south.y()))) + 1);
  for (int row = first; row <= last; ++row) {
    const double y = grid_.y_center(row);
    if (!(south.y() <= y && y < north.y())) continue;
    const double share = (y - south.y()) / (north.y() - south.y());
    crossings_[row].push_back(south.x() + share * (north.x() - south.x()));
  }
}

int PolygonCells::first_column(double x) const {
  const double column = std::ceil((x - grid_.west_m) / grid_.cell_m - 0.5);
  return static_cast<int>(std::clamp(column, 0.0, double(grid_.n_cols)));
}

std::vector<std::size_t> PolygonCells::finish() {
  std::vector<std::size_t> cells;
  const auto width = static_cast<std::size_t>(window_.n_cols);
  for (auto& [row, crossings] : crossings_) {
    std::sort(crossings.begin(), crossings.end());
    const bool listed = row >= window_.row0 && row < window_.end_row();
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const int from = first_column(crossings[i]), end = first_column(crossings[i + 1]);
      count_ += static_cast<std::size_t>(std::max(0, end - from));
      if (!listed) continue;
      for (int col = std::max(from, window_.col0); col < std::min(end, window_.end_col()); ++col)
        cells.push_back(static_cast<std::size_t>(row - window_.row0) * width +
                        static_cast<std::size_t>(col - window_.col0));
    }
  }
  return cells;
}

}  // namespace sturz
