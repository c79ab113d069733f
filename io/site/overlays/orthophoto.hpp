// SPDX-License-Identifier: Apache-2.0
/// A picture of the ground from above for a page, as small as a page can hold.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/scenario.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

/// Longer side of the picture at most [pixels].
inline constexpr int most_photo_pixels = 1600;

/// That the file is there and has colours. Does nothing without report.orthophoto.
/// \throws SetupError naming file and reason
void check_orthophoto(const Scenario& scenario);

/// report.orthophoto over `view`, warped to its system, as a JPEG file; empty without one. White
/// where the raster has nothing. \throws SetupError as above
std::vector<std::uint8_t> orthophoto_jpeg(const Scenario& scenario, const Grid& view);

}  // namespace sturz
