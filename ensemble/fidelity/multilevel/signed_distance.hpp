// SPDX-License-Identifier: Apache-2.0
/// How deep inside a set of cells, or how far outside, each cell lies.
#pragma once

#include "engine/terrain/raster.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

/// Distance of each cell's centre to the nearest centre on the other side of the set's outline,
/// less half a cell: positive inside, negative outside [m]. Exact (Felzenszwalb and Huttenlocher
/// 2012, Theory of Computing 8, 415-428). Where all cells are of one kind, the raster's half
/// perimeter.
Raster<float> signed_distance(const Raster<std::uint8_t>& inside);

}  // namespace sturz
