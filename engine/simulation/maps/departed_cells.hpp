// SPDX-License-Identifier: Apache-2.0
/// Cells of a map over whose edge mass left the known ground.
#pragma once

#include "engine/effects/moving_set.hpp"
#include "engine/terrain/raster.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace sturz {

/// The cell of the hazard grid where a particle was last seen; off the grid there is none.
inline std::optional<std::pair<int, int>> cell_of(const Departure& gone, const Grid& g) {
  if (!std::isfinite(gone.x + gone.y)) return std::nullopt;
  const double row = std::floor((g.north_m - gone.y) / g.cell_m);
  const double col = std::floor((gone.x - g.west_m) / g.cell_m);
  if (!(row >= 0 && row < g.n_rows && col >= 0 && col < g.n_cols)) return std::nullopt;
  return std::pair(static_cast<int>(row), static_cast<int>(col));
}

/// Window of the cells over whose edge mass left.
inline Window window_of_departures(std::span<const MovingSet> sets, const Grid& g) {
  Window all;
  for (const MovingSet& set : sets)
    for (const Departure& gone : set.departures)
      if (const auto cell = cell_of(gone, g)) all = joined(all, {cell->first, cell->second, 1, 1});
  return all;
}

}  // namespace sturz
