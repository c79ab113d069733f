// SPDX-License-Identifier: Apache-2.0
#include "io/site/terrain_window.hpp"

#include "engine/core/error.hpp"
#include "io/site/polygon_cover.hpp"
#include "io/site/polygon_layer.hpp"
#include "scenarios/assembly/inflow/inflow_plan.hpp"
#include "scenarios/assembly/liquid/pool.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

OGREnvelope extent_of_polygons(const Scenario& scenario, const Grid& terrain) {
  const GdalScope scope;
  PolygonRequest request;
  request.path = scenario.terrain.window->polygon;
  request.key = "terrain.window.polygon";
  request.directory = scenario.directory;
  request.crs_key.clear();  // the file itself has to say it
  request.layer_key.clear();
  request.what = "window";
  PolygonLayer layer = open_polygon_layer(request);
  OGREnvelope extent;
  for (const auto& feature : read_features(layer, request, terrain)) {
    OGREnvelope own;
    feature.polygons->getEnvelope(&own);
    extent.Merge(own);
  }
  return extent;
}

/// What terrain.window names, as cells.
Window window_by_hand(const Scenario& scenario, const Grid& terrain) {
  const TerrainWindow& wanted = *scenario.terrain.window;
  OGREnvelope e;
  if (wanted.polygon.empty()) {
    e.MinX = wanted.x_m[0], e.MaxX = wanted.x_m[1];
    e.MinY = wanted.y_m[0], e.MaxY = wanted.y_m[1];
  } else {
    e = extent_of_polygons(scenario, terrain);
  }
  const bool apart = e.MaxX <= terrain.west_m || e.MinX >= terrain.east_m() ||
                     e.MaxY <= terrain.south_m() || e.MinY >= terrain.north_m;
  require(
      !apart,
      fmt::format("terrain.window: holds nothing of the raster (window x {:.10g} to {:.10g}, y "
                  "{:.10g} to {:.10g}; raster x {:.10g} to {:.10g}, y {:.10g} to {:.10g}). Give "
                  "map coordinates of the working system, or leave it out.",
                  e.MinX, e.MaxX, e.MinY, e.MaxY, terrain.west_m, terrain.east_m(),
                  terrain.south_m(), terrain.north_m));
  return cells_under(e.MinX, e.MaxX, e.MinY, e.MaxY, terrain);
}

/// A mass cannot start where the ground is not known. \return the highest ground below it [m]
double surface_below(const Scenario& scenario, const Raster<double>& release,
                     const Raster<double>& ground, const Window& at, const std::string& label) {
  std::size_t count = 0, first = 0;
  double highest = -INFINITY;
  for (std::size_t i = 0; i < release.values.size(); ++i) {
    if (!(release.values[i] > 0)) continue;
    if (!std::isnan(ground.values[i]))
      highest = std::max(highest, ground.values[i]);
    else if (count++ == 0)
      first = i;
  }
  if (count == 0) return highest;
  const Grid& g = release.grid;
  const int row = static_cast<int>(first / static_cast<std::size_t>(g.n_cols));
  const int col = static_cast<int>(first % static_cast<std::size_t>(g.n_cols));
  throw SetupError(fmt::format(
      "{}: lies on {} nodata cells of terrain.raster = {}, the first at row {}, column {} (x "
      "{:.10g}, y {:.10g}). Fill the terrain there or move the release.",
      label, count, scenario.terrain.raster, at.row0 + row, at.col0 + col, g.x_center(col),
      g.y_center(row)));
}

}  // namespace

FirstGround first_ground(const Scenario& scenario, const SceneInputs& inputs,
                         const ReadGround& read, const std::string& release_label) {
  const Grid& whole = inputs.terrain_grid();
  const Window at = window_of(inputs.release->grid, whole);
  double surface = surface_below(scenario, *inputs.release, read(at), at, release_label);
  for (const InflowSource& source : inputs.inflow)
    for (const double z : read(cells_below(source, whole)).values)
      if (std::isfinite(z)) surface = std::max(surface, z);
  require(std::isfinite(surface) || inputs.inflow.empty(),
          "inflow: lies on nodata cells of the terrain. Fill the terrain there or move it.");
  FirstGround first{{}, whole_of(whole)};
  if (!scenario.domain.periodic.empty()) return first;
  const EnergyLine line = energy_line(scenario, inputs, surface);
  if (line.release.n_cells() == 0) return first;  // refused where its thickness is looked at
  first.reach = followed(line, whole, read);
  const double spacing = scenario.numerics.spacing_m;
  if (scenario.terrain.window)
    first.window =
        joined(window_by_hand(scenario, whole), with_margin(line.release, whole, spacing));
  else if (!scenario.terrain.synthetic)
    first.window = with_margin(first.reach->window, whole, spacing);
  if (scenario.fluid && scenario.fluid->pool)
    first.window = joined(first.window, with_margin(pool_window(inputs), whole, spacing));
  return first;
}

}  // namespace sturz
