// SPDX-License-Identifier: Apache-2.0
/// Dams and buildings from their files to the ground. Included by .cpp files only.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/assembly/reach.hpp"
#include "scenarios/ground_structures.hpp"
#include "scenarios/input_identity.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <string>
#include <vector>

namespace sturz {

struct StructureFile {
  std::vector<std::string> notes, warnings;
  InputIdentity identity;  ///< without a role: nothing was read
};

/// Lines of terrain.dams[i], with the ground below them.
struct DamRead : StructureFile {
  std::vector<DamLine> lines;
};
/// \param read elevations without dams; empty: no terrain is known, the file is only checked
/// \throws SetupError naming key and file: missing file, layer or field; no coordinate system;
///   points or polygons; a height that is missing or not positive; a line beyond the known ground
DamRead read_dam_lines(const Scenario&, std::size_t dam, const Grid& terrain,
                       const ReadGround& read);

struct BuildingsRead : StructureFile {
  std::vector<RaisedCell> cells;  ///< on the window
  int n_buildings = 0;
};
/// \throws SetupError as read_zone_cells; a height that is missing or not positive
BuildingsRead read_buildings(const Scenario&, const Grid& terrain, const Window& held);
/// What can be said of the file without a terrain.
void check_buildings(const Scenario&);

/// The ground around all dams, how far their sides go, and in words what each does to it.
/// \param cell_m of the coarsest ground that members may feel
void survey_dams(const Scenario&, const Grid& terrain, const ReadGround& read, double cell_m,
                 SceneInputs&);

/// Each uncertain height at the middle of its range.
std::vector<DamSpec> at_middle_height(std::vector<DamSpec>);

/// Raises buildings and those dams whose height is the same for all members.
/// \param cells of buildings, on the same window
void stand_on(const Scenario&, const GroundStructures&, const std::vector<RaisedCell>& cells,
              Raster<double>& ground);

}  // namespace sturz
