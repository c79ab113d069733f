// SPDX-License-Identifier: Apache-2.0
/// Elevations on the cells of maps, to be written as maps are.
#pragma once

#include "scenarios/layers/layer_stream.hpp"

#include <functional>
#include <memory>

namespace sturz::workflow {

/// Elevations that hold all of the given cells that lie on the terrain.
using GroundAt = std::function<std::shared_ptr<const Raster<double>>(const Grid& cells)>;

/// One layer, "elevation" [m], on the grid of the maps; NaN where the ground is not known. The
/// ground is asked for in bands of rows across the whole map, so that no more need be held.
std::shared_ptr<const LayerSource> ground_source(const Grid& maps, GroundAt ground);

}  // namespace sturz::workflow
