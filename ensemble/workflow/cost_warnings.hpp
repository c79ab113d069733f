// SPDX-License-Identifier: Apache-2.0
/// Long work is announced, with what would be cheaper.
#pragma once

#include "ensemble/workflow/scene.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz::workflow {

/// One sentence where `members` members on `cores` cores are predicted to take more than ten
/// minutes: a coarser spacing that still resolves the release, the other formulation. Columns cost
/// spacing^-3, full stress spacing^-4.
std::vector<std::string> cost_warnings(const Scene&, std::int64_t members, int cores);

}  // namespace sturz::workflow
