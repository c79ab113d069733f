// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/edge_crossing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace sturz {
namespace {

enum Side { north, east, south, west, inside };
constexpr std::array<const char*, 4> names{"northern", "eastern", "southern", "western"};

struct Crossing {
  Side side = inside;
  double weight = 0;  ///< sum of the shares of members
  double from_x = std::numeric_limits<double>::infinity(), to_x = -from_x;
  double from_y = from_x, to_y = -from_x;
};

/// The side of the terrain that a cell touches, `reach` metres tolerated.
Side side_of(double x, double y, const Grid& terrain, double reach) {
  const std::array<double, 4> away{terrain.north_m - y, terrain.east_m() - x, y - terrain.south_m(),
                                   x - terrain.west_m};
  const auto* nearest = std::min_element(away.begin(), away.end());
  return *nearest <= reach ? static_cast<Side>(nearest - away.begin()) : inside;
}

std::string text_of(const Crossing& c) {
  if (c.side == inside)
    return fmt::format(
        "where the raster holds no elevation (x {:.0f} to {:.0f}, y {:.0f} to {:.0f})", c.from_x,
        c.to_x, c.from_y, c.to_y);
  const bool along_x = c.side == north || c.side == south;
  return fmt::format("over the {} edge ({} {:.0f} to {:.0f})", names[c.side], along_x ? 'x' : 'y',
                     along_x ? c.from_x : c.from_y, along_x ? c.to_x : c.to_y);
}

const Layer* layer_of_what_left(const LayerStack& maps) {
  for (const Layer& layer : maps.layers)
    if (layer.meaning.quantity == Quantity::left && !layer.meaning.is_bound() &&
        !layer.values.empty())
      return &layer;
  return nullptr;
}

}  // namespace

std::string where_mass_left(const LayerStack& maps, const Grid& terrain) {
  const Layer* layer = layer_of_what_left(maps);
  if (layer == nullptr) return {};
  const Grid& g = maps.grid;
  // A particle counts in the last cell in which it was seen: up to a step before the edge.
  const double reach = 1.5 * g.cell_m + 2 * terrain.cell_m;
  std::array<Crossing, 5> sides;
  for (std::size_t i = 0; i < g.n_cells(); ++i) {
    const float share = layer->values[i];
    if (!(share > 0)) continue;
    const double x = g.west_m + (static_cast<double>(i % g.n_cols) + 0.5) * g.cell_m;
    const double y = g.north_m - (static_cast<double>(i / g.n_cols) + 0.5) * g.cell_m;
    const Side side = side_of(x, y, terrain, reach);
    Crossing& c = sides[side];
    c.side = side;
    c.weight += static_cast<double>(share);
    c.from_x = std::min(c.from_x, x - g.cell_m / 2), c.to_x = std::max(c.to_x, x + g.cell_m / 2);
    c.from_y = std::min(c.from_y, y - g.cell_m / 2), c.to_y = std::max(c.to_y, y + g.cell_m / 2);
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Crossing& a, const Crossing& b) { return a.weight > b.weight; });
  std::string text;
  for (const Crossing& c : sides)
    if (c.weight > 0) text += (text.empty() ? "" : " and ") + text_of(c);
  return text;
}

}  // namespace sturz
