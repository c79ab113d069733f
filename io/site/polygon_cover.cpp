// SPDX-License-Identifier: Apache-2.0
#include "io/site/polygon_cover.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {

double ring_area(std::span<const Vec2> ring) {
  if (ring.size() < 3) return 0;
  // Relative to the first point: map coordinates are large and would eat the digits.
  double twice = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Vec2 a = ring[i] - ring[0], b = ring[i + 1] - ring[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

Window cells_under(double west, double east, double south, double north, const Grid& g) {
  const auto cell = [](double at, int n) {
    return static_cast<int>(std::clamp(std::floor(at), -2.0, n + 2.0));
  };
  return window_between(cell((g.north_m - north) / g.cell_m, g.n_rows) - 1,
                        cell((g.north_m - south) / g.cell_m, g.n_rows) + 2,
                        cell((west - g.west_m) / g.cell_m, g.n_cols) - 1,
                        cell((east - g.west_m) / g.cell_m, g.n_cols) + 2, g);
}

PolygonCover::PolygonCover(Grid grid, const Window& window)
    : grid_(std::move(grid)),
      window_(window),
      steps_(static_cast<std::size_t>(window.n_cols + 1) * window.n_rows, 0.0) {}

void PolygonCover::add_ring(std::span<const Vec2> ring, double weight) {
  if (ring.size() < 3) return;
  largest_weight_ = std::max(largest_weight_, std::abs(weight));
  const double signed_weight = ring_area(ring) > 0 ? weight : -weight;
  const auto column = [&](const Vec2& p) {
    return std::clamp((p.x() - grid_.west_m) / grid_.cell_m, 0.0, double(grid_.n_cols));
  };
  const auto row = [&](const Vec2& p) {
    return std::clamp((grid_.north_m - p.y()) / grid_.cell_m, 0.0, double(grid_.n_rows));
  };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    add_edge(column(a), row(a), column(b), row(b), signed_weight);
  }
}

// Counter-clockwise rings run south on their western side: there rows (v) grow and everything east
// of the edge is added; on the eastern side rows fall and it is taken away again.
void PolygonCover::add_edge(double u0, double v0, double u1, double v1, double weight) {
  if (v0 == v1) return;
  const double sign = v1 > v0 ? weight : -weight;
  if (v1 < v0) {
    std::swap(u0, u1);
    std::swap(v0, v1);
  }
  const double slope = (u1 - u0) / (v1 - v0);
  const int last = std::min(static_cast<int>(std::floor(v1)), grid_.n_rows - 1);
  for (int r = static_cast<int>(std::floor(v0)); r <= last; ++r) {
    const double top = std::max(v0, double(r)), bottom = std::min(v1, r + 1.0);
    if (bottom <= top) continue;
    const double lo = std::min(u0, u1), hi = std::max(u0, u1);
    const double at_top = std::clamp(u0 + slope * (top - v0), lo, hi);
    const double at_bottom = std::clamp(u0 + slope * (bottom - v0), lo, hi);
    add_in_row(r, std::min(at_top, at_bottom), std::max(at_top, at_bottom), sign * (bottom - top));
  }
}

void PolygonCover::add_in_row(int row, double u0, double u1, double dv) {
  if (row < window_.row0 || row >= window_.end_row()) return;
  double* steps = &steps_[static_cast<std::size_t>(row - window_.row0) * (window_.n_cols + 1)];
  const auto add = [&](int col_of_grid, double mean_offset, double part) {
    const int col = col_of_grid - window_.col0;
    if (col < 0 || col >= window_.n_cols) return;
    steps[col] += part * (1 - mean_offset);
    steps[col + 1] += part * mean_offset;
  };
  const int first = std::min(static_cast<int>(std::floor(u0)), grid_.n_cols - 1);
  const int last = std::min(static_cast<int>(std::floor(u1)), grid_.n_cols - 1);
  if (first == last) return add(first, (u0 + u1) / 2 - first, dv);
  for (int c = first; c <= last; ++c) {
    const double from = std::max(u0, double(c)), to = std::min(u1, c + 1.0);
    if (to > from) add(c, (from + to) / 2 - c, dv * (to - from) / (u1 - u0));
  }
}

Raster<double> PolygonCover::finish() const {
  // Sums along a row leave dust of this order where nothing lies.
  const double dust = 1e-11 * largest_weight_;
  Raster<double> cover(grid_of(window_, grid_), 0.0);
  for (int r = 0; r < window_.n_rows; ++r) {
    const double* steps = &steps_[static_cast<std::size_t>(r) * (window_.n_cols + 1)];
    double sum = 0;
    for (int c = 0; c < window_.n_cols; ++c) {
      sum += steps[c];
      cover.at(r, c) = sum > dust ? sum : 0;
    }
  }
  return cover;
}

}  // namespace sturz
