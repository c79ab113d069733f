// SPDX-License-Identifier: Apache-2.0
/// Finding the files that a scenario names, and saying so when one is not there.
#pragma once

#include <string>

namespace sturz {

/// Where a file is and which scenario key named it.
struct InputFile {
  std::string path;   ///< as GDAL shall open it
  std::string label;  ///< how errors and notes call it, e.g. "terrain.raster = bed.tif"
};

/// \param written the key's value; relative paths start at `directory`. Names that GDAL alone
///   understands (/vsizip/..., NETCDF:file.nc:z) are kept as they are.
/// \throws SetupError when a plain file is missing, with the nearest name in its folder
InputFile find_input(const std::string& key, const std::string& written,
                     const std::string& directory);

}  // namespace sturz
