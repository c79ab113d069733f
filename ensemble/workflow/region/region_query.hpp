// SPDX-License-Identifier: Apache-2.0
/// Which sources of a region hit a place.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sturz::workflow {

struct SourcesAt {
  double x_m = 0, y_m = 0;                              ///< centre of the cell
  int row = -1, col = -1;                               ///< of the maps
  std::vector<std::pair<std::string, double>> sources;  ///< name and probability, largest first
  /// Values of the maps there, by the name of their GeoTIFF, in the maps' order.
  std::vector<std::pair<std::string, double>> values;
};

/// From hazard.nc alone. \param x_m,y_m in the coordinate system of the maps
/// \throws SetupError where the folder has no region's maps, or the place lies beyond them
SourcesAt sources_at(const std::filesystem::path& region, double x_m, double y_m);

}  // namespace sturz::workflow
