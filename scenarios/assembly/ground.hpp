// SPDX-License-Identifier: Apache-2.0
/// The ground that members share: built once per scene, laid over by each member's excavation.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/terrain/terrain.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

namespace sturz {

/// Cells that are averaged into one for columns: a column feels no ground finer than its spacing,
/// and a step may not cross more than half a cell. 1 where the ground is periodic.
int column_ground_factor(const Scenario&, const SceneInputs&);

/// Means of factor x factor cells; NaN where one of them is unknown. Cells that do not fill a
/// block at the eastern and southern edge are left out.
Raster<double> coarsened(const Raster<double>&, int factor);

/// The same of the part of a grid that is held: every block that lies wholly in it, on the grid of
/// these blocks alone. Blocks are counted from the corner of the whole grid.
Raster<double> coarsened(const Raster<double>& part, const Grid& whole, int factor);
/// The grid of all blocks.
Grid coarse_grid(const Grid& whole, int factor);

/// The ground at the working grid, or averaged for columns; taken from the inputs where
/// prepare_grounds put it there.
Terrain scene_ground(const Scenario&, const SceneInputs&, const Domain&, bool for_columns);

/// Builds both grounds that the scene may need into the inputs, so that members only copy them.
void prepare_grounds(const Scenario&, SceneInputs&);

}  // namespace sturz
