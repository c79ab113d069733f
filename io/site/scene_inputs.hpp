// SPDX-License-Identifier: Apache-2.0
/// Loads every file that a scene names, once, and checks them against each other.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

namespace sturz {

/// Terrain (raster or formula), release pattern on the terrain's grid, hazard grid, notes, warnings
/// and the identity of every file (named as in the scenario's folder).
/// \throws SetupError naming key and file, for all files at once, one a line; also for a release on
///   nodata cells of the terrain
SceneInputs load_scene_inputs(const Scenario& scenario);

/// The same scene with more of its raster: the window of a higher level, see larger_window. Only
/// elevation, zones and what is said of them are read anew. \pre the terrain is a raster
SceneInputs load_larger_inputs(const Scenario& scenario, const SceneInputs& first, int level);

}  // namespace sturz
