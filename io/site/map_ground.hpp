// SPDX-License-Identifier: Apache-2.0
/// The ground under a map, whatever part of the raster members were computed on.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <memory>

namespace sturz {

/// Elevations that hold every cell of the terrain under the map: those of `inputs` where they do,
/// read from the raster where the map goes on beyond them. What a map calls known ground so depends
/// on the raster alone. Lies on inputs.terrain_grid().
/// \throws SetupError when the raster cannot be read, or is another than `inputs` came from
std::shared_ptr<const Raster<double>> ground_of_map(const Scenario&, const SceneInputs& inputs,
                                                    const Grid& map);

}  // namespace sturz
