// SPDX-License-Identifier: Apache-2.0
#include "io/site/map_ground.hpp"

#include "engine/core/error.hpp"
#include "io/gdal/gdal_raster.hpp"
#include "io/site/structures/structure_inputs.hpp"
#include "io/site/terrain_request.hpp"
#include "scenarios/assembly/structures/dams.hpp"

#include <fmt/core.h>

namespace sturz {
namespace {

bool meet(const Window& a, const Window& b) {
  return a.row0 < b.end_row() && b.row0 < a.end_row() && a.col0 < b.end_col() &&
         b.col0 < a.end_col();
}

/// The relief shows what stands on the ground; dams of uncertain height at the middle of its range.
std::shared_ptr<const Raster<double>> with_member_dams(const Scenario& scenario,
                                                       const SceneInputs& inputs,
                                                       std::shared_ptr<const Raster<double>> z) {
  if (!inputs.structures.any_by_member()) return z;
  auto own = std::make_shared<Raster<double>>(*z);
  raise_dams(inputs.structures, at_middle_height(scenario.terrain.dams), WhichDams::by_member,
             *own);
  return own;
}

}  // namespace

std::shared_ptr<const Raster<double>> ground_of_map(const Scenario& scenario,
                                                    const SceneInputs& inputs, const Grid& map) {
  const Grid& whole = inputs.terrain_grid();
  // One cell more: rounding may put a centre that lies on an edge to either side.
  const Window under =
      widened(window_between(whole.row_of(map.north_m), whole.row_of(map.south_m()) + 1,
                             whole.col_of(map.west_m), whole.col_of(map.east_m()) + 1, whole),
              1, whole);
  const Window held = inputs.held();
  if (map.n_cells() == 0 || under.n_cells() == 0 || held.contains(under))
    return with_member_dams(scenario, inputs, inputs.elevation);
  ElevationRaster raster(terrain_request(scenario));
  require(raster.grid().same_place(whole),
          fmt::format("terrain.raster = {}: has another grid than before (it was changed while "
                      "members were computed). Take the file back and go on.",
                      scenario.terrain.raster));
  // The page shows ground around the map too. A map of nothing may lie far from what is held.
  const Window shown = meet(held, under) ? joined(held, under) : under;
  Raster<double> ground = raster.look(shown);
  std::vector<RaisedCell> houses;
  if (scenario.terrain.buildings) houses = read_buildings(scenario, whole, shown).cells;
  stand_on(scenario, inputs.structures, houses, ground);
  return with_member_dams(scenario, inputs,
                          std::make_shared<const Raster<double>>(std::move(ground)));
}

}  // namespace sturz
