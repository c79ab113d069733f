// SPDX-License-Identifier: Apache-2.0
/// Relief shading of an elevation raster, light enough to carry colours on top.
#pragma once

#include "engine/terrain/raster.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

/// Shading from four directions (mostly north-west) with Horn's slopes; gentle ground is
/// exaggerated up to three times so that gullies stay visible. Unknown ground is white.
/// \return [n_rows][n_cols], 0..255, in 64 steps (they compress well)
std::vector<std::uint8_t> hillshade(const Raster<double>& ground);

}  // namespace sturz
