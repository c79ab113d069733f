// SPDX-License-Identifier: Apache-2.0
#include "scenarios/shapes/frame.hpp"

#include "engine/core/error.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz::shapes {
namespace {

double cleaned(double v) { return std::abs(v) < 1e-15 ? 0 : v; }  // cos 90 deg is not 6e-17 here

int n_cells_over(double length, double cell_m) {
  return std::max(1, static_cast<int>(std::ceil(length / cell_m - 1e-9)));
}

}  // namespace

Frame::Frame(double azimuth_deg)
    : east_(cleaned(std::sin(azimuth_deg * std::numbers::pi / 180))),
      north_(cleaned(std::cos(azimuth_deg * std::numbers::pi / 180))) {}

Grid Frame::grid_over(double s0, double s1, double n0, double n1, double cell_m) const {
  double west = INFINITY, east = -INFINITY, south = INFINITY, north = -INFINITY;
  for (const double s : {s0, s1})
    for (const double n : {n0, n1}) {
      const double x = s * east_ - n * north_, y = s * north_ + n * east_;
      west = std::min(west, x);
      east = std::max(east, x);
      south = std::min(south, y);
      north = std::max(north, y);
    }
  return grid_from_corner(west, south, east - west, north - south, cell_m);
}

Grid grid_from_corner(double west, double south, double width, double height, double cell_m) {
  const double cells = width / cell_m * (height / cell_m);
  require(cells <= 1e8, "terrain.synthetic: cell_size_m = " + number_text(cell_m) +
                            " (would make " + number_text(std::round(cells)) +
                            " cells; at most 100000000). Use larger cells.");
  Grid grid;
  grid.cell_m = cell_m;
  grid.n_cols = n_cells_over(width, cell_m);
  grid.n_rows = n_cells_over(height, cell_m);
  grid.west_m = west;
  grid.north_m = south + grid.n_rows * cell_m;
  return grid;
}

}  // namespace sturz::shapes
