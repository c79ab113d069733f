// SPDX-License-Identifier: Apache-2.0
#include "io/doubts/release_doubts.hpp"

#include "engine/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr double nearest_edge_cells = 10;

/// Of a slide's thickness to the width of its source; the steepest known are near 0.2.
constexpr double thickest_share = 0.5;

}  // namespace

void refuse_mask(std::span<const double> thickness, double factor, const std::string& label) {
  if (factor != 1) return;
  std::size_t count = 0;
  for (const double v : thickness) {
    if (v > 0 && v != 255) return;
    count += v == 255;
  }
  if (count == 0) return;
  throw SetupError(
      fmt::format("{}: all {} cells above zero hold 255 (a mask, not a thickness in metres). Give "
                  "the outline as release.polygon with release.thickness_m, or say what 255 stands "
                  "for: release.thickness_factor: 0.0078431 makes it 2 m.",
                  label, count));
}

std::string thickness_doubt(double volume_m3, double area_m2, double largest_m, double factor,
                            const std::string& label) {
  if (!(area_m2 > 0)) return {};
  const double mean = volume_m3 / area_m2, width = std::sqrt(area_m2);
  if (mean <= thickest_share * width) return {};
  return fmt::format(
      "{}: is {:.4g} m thick on average (at most {:.4g} m) on {:.4g} m2, {:.2g} times as thick as "
      "wide; slides are below 0.2. If the values are centimetres, set release.thickness_factor: "
      "{:g}",
      label, mean, largest_m, area_m2, mean / width, 0.01 * factor);
}

std::string edge_doubt(const Raster<double>& pattern, const Grid& terrain,
                       const std::string& label) {
  const Grid& g = pattern.grid;
  int west = g.n_cols, east = -1, north = g.n_rows, south = -1;
  for (int row = 0; row < g.n_rows; ++row)
    for (int col = 0; col < g.n_cols; ++col) {
      if (!(pattern.at(row, col) > 0)) continue;
      west = std::min(west, col), east = std::max(east, col);
      north = std::min(north, row), south = std::max(south, row);
    }
  if (east < 0) return {};
  struct Side {
    double distance;
    const char* name;
  };
  const Side sides[] = {{g.west_m + west * g.cell_m - terrain.west_m, "western"},
                        {terrain.east_m() - g.west_m - (east + 1) * g.cell_m, "eastern"},
                        {terrain.north_m - g.north_m + north * g.cell_m, "northern"},
                        {g.north_m - (south + 1) * g.cell_m - terrain.south_m(), "southern"}};
  const Side& nearest =
      *std::min_element(std::begin(sides), std::end(sides),
                        [](const Side& a, const Side& b) { return a.distance < b.distance; });
  if (nearest.distance >= nearest_edge_cells * g.cell_m - 1e-6 * g.cell_m) return {};
  return fmt::format(
      "{}: lies {:.4g} m ({:.0f} cells) from the {} edge of the terrain. What spreads "
      "beyond it is lost: use a larger terrain if mass can go that way",
      label, std::max(0.0, nearest.distance), std::max(0.0, nearest.distance) / g.cell_m,
      nearest.name);
}

}  // namespace sturz
