// SPDX-License-Identifier: Apache-2.0
/// The grid that the maps of all members share.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/scenario.hpp"

namespace sturz {

/// The terrain's whole grid, or one of hazard.cell_size_m that covers it.
/// \throws SetupError naming the key
Grid hazard_grid(const Scenario& scenario, const Grid& terrain);

}  // namespace sturz
