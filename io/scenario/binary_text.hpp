// SPDX-License-Identifier: Apache-2.0
/// What is no scenario at all, whatever its size.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace sturz {

/// What begins as rasters and tables of other programs do (TIFF, netCDF, HDF5, SQLite, zip): one
/// was named in place of the scenario.
inline bool looks_binary(std::string_view text) {
  using namespace std::string_view_literals;
  constexpr std::array beginnings{"II*\0"sv,   "MM\0*"sv,           "II+\0"sv, "MM\0+"sv,
                                  "CDF\1"sv,   "CDF\2"sv,           "CDF\5"sv, "\x89HDF"sv,
                                  "\x89PNG"sv, "SQLite format 3"sv, "PK\3\4"sv};
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [text](std::string_view b) { return text.starts_with(b); });
}
inline constexpr const char* binary_words =
    "is binary, such as a raster, and no scenario. `sturz init RASTER RELEASE -o DIR` writes one "
    "around an elevation raster.";

}  // namespace sturz
