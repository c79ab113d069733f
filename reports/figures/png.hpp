// SPDX-License-Identifier: Apache-2.0
/// Pictures as PNG files in memory.
#pragma once

#include "reports/figures/colours.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sturz {

/// \param grey [height][width], 0 black .. 255 white
std::vector<std::uint8_t> grey_png(std::span<const std::uint8_t> grey, int width, int height);
/// \param index [height][width] into `palette`; index 0 is fully transparent
/// \param palette 1..256 colours
std::vector<std::uint8_t> palette_png(std::span<const std::uint8_t> index, int width, int height,
                                      std::span<const Rgb> palette);
/// "data:image/png;base64,..."
std::string data_uri(std::span<const std::uint8_t> png);

}  // namespace sturz
