// SPDX-License-Identifier: Apache-2.0
// Dams and buildings of a scene.
#include "io/site/loading/loading.hpp"
#include "io/site/structures/structure_inputs.hpp"
#include "scenarios/assembly/ground.hpp"

namespace sturz {
namespace {

void take_file(Loading& loading, StructureFile& read) {
  if (read.identity.role.empty()) return;  // an inline line
  loading.take(read);
}

}  // namespace

void load_structures(Loading& loading, const ReadGround& read) {
  const Scenario& scenario = loading.scenario;
  SceneInputs& in = loading.inputs;
  if (scenario.terrain.dams.empty()) return;
  const std::size_t before = loading.problems.size();
  for (std::size_t i = 0; i < scenario.terrain.dams.size(); ++i)
    loading.attempt([&] {
      DamRead dam = read_dam_lines(scenario, i, loading.grid(), read);
      take_file(loading, dam);
      std::move(dam.lines.begin(), dam.lines.end(), std::back_inserter(in.structures.dams));
    });
  if (loading.problems.size() > before) return in.structures.dams.clear();
  const double coarsest = column_ground_factor(scenario, in) * loading.grid().cell_m;
  survey_dams(scenario, loading.grid(), read, coarsest, in);
}

void stand_structures(Loading& loading) {
  const Scenario& scenario = loading.scenario;
  SceneInputs& in = loading.inputs;
  if (scenario.terrain.dams.empty() && !scenario.terrain.buildings) return;
  loading.attempt([&] {
    if (scenario.terrain.buildings) {
      BuildingsRead read = read_buildings(scenario, loading.grid(), in.held());
      take_file(loading, read);
      in.structures.buildings = std::move(read.cells);
      in.structures.n_buildings = read.n_buildings;
    }
    Raster<double> ground = *in.elevation;
    stand_on(scenario, in.structures, in.structures.buildings, ground);
    in.elevation = std::make_shared<const Raster<double>>(std::move(ground));
  });
}

void check_structures(Loading& loading) {
  const Scenario& scenario = loading.scenario;
  for (std::size_t i = 0; i < scenario.terrain.dams.size(); ++i)
    loading.attempt([&] { read_dam_lines(scenario, i, {}, {}); });
  if (scenario.terrain.buildings) loading.attempt([&] { check_buildings(scenario); });
}

}  // namespace sturz
