// SPDX-License-Identifier: Apache-2.0
#include "io/site/hazard_grid.hpp"

#include "engine/core/error.hpp"
#include "io/gdal/raster_source.hpp"

#include <fmt/core.h>

#include <cmath>

namespace sturz {

Grid hazard_grid(const Scenario& scenario, const Grid& terrain) {
  if (!scenario.hazard.cell_size_m) return terrain;
  const double cell = *scenario.hazard.cell_size_m;
  require(cell > 0,
          fmt::format("hazard.cell_size_m = {:g} (must be positive). Give metres.", cell));
  // Enough cells to cover the terrain; one that would only hold round-off is not added.
  const double n_cols = std::ceil((terrain.east_m() - terrain.west_m) / cell - 1e-6);
  const double n_rows = std::ceil((terrain.north_m - terrain.south_m()) / cell - 1e-6);
  require_raster_size(n_cols, n_rows, "hazard.cell_size_m");
  return {static_cast<int>(n_cols), static_cast<int>(n_rows), terrain.west_m, terrain.north_m, cell,
          terrain.crs_wkt};
}

}  // namespace sturz
