// SPDX-License-Identifier: Apache-2.0
/// The grid on which members keep what they touch, and maps are made.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/scenario.hpp"

namespace sturz {

/// The terrain's own, or cells of `hazard.cell_size_m` from its north-west corner.
/// \throws SetupError for a size that is not positive, or too many cells
Grid hazard_grid(const Scenario&, const Grid& terrain);

}  // namespace sturz
