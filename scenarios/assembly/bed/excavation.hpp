// SPDX-License-Identifier: Apache-2.0
/// The bed of a release that the terrain still holds.
#pragma once

#include "engine/terrain/terrain.hpp"

namespace sturz {

/// bed = pre-failure surface - thickness, as a patch over the shared raster.
/// \param whole the working grid, of which the thickness covers a part
Terrain excavate(const Terrain& ground, const Raster<double>& thickness, const Grid& whole);

}  // namespace sturz
