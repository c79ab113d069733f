// SPDX-License-Identifier: Apache-2.0
/// Long work is announced, with what would be cheaper.
#pragma once

#include "ensemble/workflow/scene.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz::workflow {

/// One sentence where `members` members on `cores` cores and `maps_s` seconds of maps are predicted
/// to take more than ten minutes, with what would be cheaper: for the members a coarser spacing
/// that still resolves the scene or the other formulation, for the maps larger cells. Columns cost
/// spacing^-3, full stress spacing^-4, maps cell^-2.
std::vector<std::string> cost_warnings(const Scene&, std::int64_t members, int cores,
                                       double maps_s = 0);

}  // namespace sturz::workflow
