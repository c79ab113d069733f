// SPDX-License-Identifier: Apache-2.0
/// Standing water of `fluid.pool`: where it stands, how much it is, and whether the ground holds
/// it.
#pragma once

#include "engine/terrain/terrain.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <string>

namespace sturz {

struct Pool {
  double surface_m = 0;  ///< elevation of its level surface [m]
  /// Share of each cell that its outline and the walls leave to it, 0..1, on cells of the working
  /// grid.
  Raster<double> share;
  double volume_m3 = 0;  ///< from the ground to the surface, grains in it included
  double area_m2 = 0, deepest_m = 0;
  /// Length of its outline where the ground beside it lies below the surface and nothing holds it.
  double open_edge_m = 0;

  bool covers(double x, double y) const;
};

/// Elevation of the bed on a cell of the working grid, around which a bed that repeats itself has a
/// margin [m].
double bed_at(const Terrain& bed, const SceneInputs&, int row, int col);

/// Of one member. \param bed of it  \throws SetupError naming the key
Pool pool_of(const Scenario& numbers, const SceneInputs&, const Terrain& bed);

/// Of the ground as it was read, for the lowest and the highest level that members may draw: there
/// is water, layers resolve it, and it does not stand at the end of the ground.
/// \throws SetupError naming the key
void require_pool(const Scenario&, const SceneInputs&);

/// Cells of the working grid that it may cover.
Window pool_window(const SceneInputs&);

/// The key that says where it is.
std::string pool_key(const PoolSpec&);

}  // namespace sturz
