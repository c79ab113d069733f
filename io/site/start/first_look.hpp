// SPDX-License-Identifier: Apache-2.0
/// What files are, before a scenario is written around them.
#pragma once

#include "engine/terrain/raster.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz {

/// A file that may outline or hold a release.
struct ReleaseFile {
  bool is_raster = false;                  ///< else a layer of features
  std::vector<std::string> number_fields;  ///< of the first layer
  std::int64_t n_features = 0;
};

/// \param directory where a relative name starts
/// \throws SetupError when the file is missing, or neither a raster nor a vector
ReleaseFile look_at_release(const std::string& path, const std::string& directory);

/// "600 x 400 cells of 10 m, WGS 84 / UTM zone 33N (EPSG:32633)".
std::string grid_text(const Grid&);

}  // namespace sturz
