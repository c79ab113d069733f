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

/// \param written the key's value; relative paths start at `directory`, also those inside names
///   that GDAL alone understands (/vsizip/dem.zip/dem.tif, NETCDF:file.nc:z)
/// \throws SetupError when a plain file is missing, with the nearest name in its folder; when it is
///   not trusted, see input_trust.hpp
InputFile find_input(const std::string& key, const std::string& written,
                     const std::string& directory);

/// A name that GDAL alone understands, with the relative file inside it made absolute; as it is
/// where there is none.
std::string anchored_gdal_name(const std::string& written, const std::string& directory);

}  // namespace sturz
