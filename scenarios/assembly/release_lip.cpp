// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/release_lip.hpp"

#include "scenarios/assembly/slope.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Volume per cell area, and the mean gradient under it.
struct Footing {
  double sum = 0;
  Vec2 gradient{0, 0};
};

Footing footing_of(const Raster<double>& ground, const Raster<double>& thickness) {
  Footing f;
  const Grid& g = thickness.grid;
  const PlaceOnGrid at(g, ground.grid);
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) {
      const double h = thickness.at(r, c);
      if (!(h > 0)) continue;
      f.sum += h;
      f.gradient += h * gradient_at(ground, at.row + r, at.col + c);
    }
  if (f.sum > 0) f.gradient /= f.sum;
  return f;
}

}  // namespace

ReleaseLip release_lip(const Raster<double>& ground, const Raster<double>& thickness, bool dug_out,
                       double friction) {
  const Grid& g = thickness.grid;
  const Footing footing = footing_of(ground, thickness);
  ReleaseLip lip;
  lip.slope = footing.gradient.norm();
  if (!(lip.slope > 1e-6)) return lip;
  const Vec2 down = -footing.gradient / lip.slope;
  const int east = static_cast<int>(std::lround(down.x())),
            south = static_cast<int>(std::lround(-down.y()));
  // Edge cells per length of edge: those whose next cell down this step lies outside.
  const double width = g.cell_m / (down.x() * east - down.y() * south);
  const PlaceOnGrid at(g, ground.grid);
  const auto level = [&](int r, int c) {
    return ground.grid.contains(at.row + r, at.col + c) ? ground.at(at.row + r, at.col + c) : nan_d;
  };
  const auto inside = [&](int r, int c) { return g.contains(r, c) && thickness.at(r, c) > 0; };
  double squares = 0, heights = 0;
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) {
      if (!inside(r, c) || inside(r + south, c + east)) continue;
      const double outside = level(r + south, c + east);  // NaN: no lip is known
      // Cells that the outline cuts hold less than the full depth: look three cells up.
      double floor = outside;
      for (int k = 0; k < 3 && inside(r - k * south, c - k * east); ++k) {
        const int row = r - k * south, col = c - k * east;
        floor = std::min(floor, level(row, col) - (dug_out ? thickness.at(row, col) : 0));
      }
      const double height = outside - floor;
      if (!(height > 0)) continue;
      lip.length_m += width;
      heights += width * height;
      squares += width * height * height;
    }
  if (lip.length_m > 0) lip.height_m = heights / lip.length_m;
  const double drive = footing.sum * g.cell_m * g.cell_m * (lip.slope - friction);
  if (drive > 0) lip.share_of_drive = 0.5 * squares / drive;
  return lip;
}

}  // namespace sturz
