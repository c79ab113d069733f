// SPDX-License-Identifier: Apache-2.0
#include "io/site/release_shapes.hpp"

#include "engine/core/error.hpp"
#include "io/site/polygon_cover.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace sturz {
namespace {

void require_on_terrain(const std::string& key, double west, double east, double south,
                        double north, const Grid& g) {
  const double beyond =
      std::max({g.west_m - west, east - g.east_m(), g.south_m() - south, north - g.north_m});
  require(beyond <= 1e-9 * g.cell_m * std::max(g.n_cols, g.n_rows),
          fmt::format("{}: reaches {:.6g} m beyond the terrain (source x {:.10g} to {:.10g}, y "
                      "{:.10g} to {:.10g}; terrain x {:.10g} to {:.10g}, y {:.10g} to {:.10g}). "
                      "Move it or use a larger terrain.",
                      key, beyond, west, east, south, north, g.west_m, g.east_m(), g.south_m(),
                      g.north_m));
}

ShapeCover cover_of_ring(const std::vector<Vec2>& ring, double area, const Grid& terrain) {
  double west = INFINITY, east = -INFINITY, south = INFINITY, north = -INFINITY;
  for (const Vec2& p : ring) {
    west = std::min(west, p.x()), east = std::max(east, p.x());
    south = std::min(south, p.y()), north = std::max(north, p.y());
  }
  PolygonCover cover(terrain, cells_under(west, east, south, north, terrain));
  cover.add_ring(ring, 1);
  return {cover.finish(), area, area};
}

/// Share of the paraboloid's height at a point, 0 outside.
double height_share(const ReleaseParaboloid& p, double x, double y) {
  const double u = (x - p.center_m[0]) / p.semi_axes_m[0];
  const double v = (y - p.center_m[1]) / p.semi_axes_m[1];
  return std::max(0.0, 1 - u * u - v * v);
}

double mean_height_share(const ReleaseParaboloid& p, double x, double y, double cell) {
  const double half = cell / 2;
  const auto inside = [&](double dx, double dy) { return height_share(p, x + dx, y + dy) > 0; };
  if (inside(-half, -half) && inside(half, -half) && inside(-half, half) && inside(half, half)) {
    // The mean of u^2 over an interval is its middle's square plus width^2 / 12.
    const auto spread = [&](double axis) { return cell * cell / (12 * axis * axis); };
    return height_share(p, x, y) - spread(p.semi_axes_m[0]) - spread(p.semi_axes_m[1]);
  }
  constexpr int n = 16;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      sum += height_share(p, x + ((i + 0.5) / n - 0.5) * cell, y + ((j + 0.5) / n - 0.5) * cell);
  return sum / (n * n);
}

}  // namespace

ShapeCover cover_of(const MapBox& box, const Grid& terrain, const char* key) {
  const auto [west, east] = box.x_m;
  const auto [south, north] = box.y_m;
  require(east > west && north > south,
          fmt::format("{}: x_m [{:g}, {:g}], y_m [{:g}, {:g}] has no area. Give the smaller "
                      "number first.",
                      key, west, east, south, north));
  require_on_terrain(key, west, east, south, north, terrain);
  return cover_of_ring({{west, south}, {east, south}, {east, north}, {west, north}},
                       (east - west) * (north - south), terrain);
}

ShapeCover cover_of(const ReleaseCylinder& cylinder, const Grid& terrain) {
  const auto [x, y] = cylinder.center_m;
  const double radius = cylinder.radius_m;
  require(radius > 0,
          fmt::format("release.cylinder: radius_m = {:g} has no area. Give metres.", radius));
  require_on_terrain("release.cylinder", x - radius, x + radius, y - radius, y + radius, terrain);
  // A polygon of so many corners, with the circle's area, stays within 1e-7 radii of the circle.
  constexpr int n = 4096;
  const double step = 2 * std::numbers::pi / n;
  const double corner = radius * std::sqrt(step / std::sin(step));
  std::vector<Vec2> ring;
  for (int i = 0; i < n; ++i)
    ring.emplace_back(x + corner * std::cos(i * step), y + corner * std::sin(i * step));
  return cover_of_ring(ring, std::numbers::pi * radius * radius, terrain);
}

ShapeCover cover_of(const ReleaseParaboloid& p, const Grid& terrain) {
  const auto [x, y] = p.center_m;
  const auto [a, b] = p.semi_axes_m;
  require(a > 0 && b > 0, fmt::format("release.paraboloid: semi_axes_m [{:g}, {:g}] have no area. "
                                      "Give metres.",
                                      a, b));
  require_on_terrain("release.paraboloid", x - a, x + a, y - b, y + b, terrain);
  const double area = std::numbers::pi * a * b, volume = area / 2;
  const Window w = cells_under(x - a, x + a, y - b, y + b, terrain);
  ShapeCover result{Raster<double>(grid_of(w, terrain), 0.0), area, volume};
  for (int row = w.row0; row < w.end_row(); ++row)
    for (int col = w.col0; col < w.end_col(); ++col)
      result.cover.at(row - w.row0, col - w.col0) =
          mean_height_share(p, terrain.x_center(col), terrain.y_center(row), terrain.cell_m);
  auto& values = result.cover.values;
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  require(sum > 0, "release.paraboloid: is too small for the terrain's cells. Use smaller cells.");
  for (double& v : values) v *= volume / (sum * terrain.cell_m * terrain.cell_m);
  return result;
}

}  // namespace sturz
