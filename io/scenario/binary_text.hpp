// SPDX-License-Identifier: Apache-2.0
/// What is no scenario at all, whatever its size.
#pragma once

#include <string_view>

namespace sturz {

/// What begins like no text: the raster was named in place of the scenario.
inline bool looks_binary(std::string_view text) {
  return text.substr(0, 1024).find('\0') != std::string_view::npos;
}
inline constexpr const char* binary_words =
    "is binary, such as a raster, and no scenario. `sturz init RASTER RELEASE -o DIR` writes one "
    "around an elevation raster.";

}  // namespace sturz
