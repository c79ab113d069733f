// SPDX-License-Identifier: Apache-2.0
/// Which raster a scenario names, and what it says about it.
#pragma once

#include <optional>
#include <string>

namespace sturz {

/// More cells than this are not read at a time; refused before anything is allocated.
inline constexpr double max_raster_cells = 400e6;
/// A grid may have more of them than are ever read.
inline constexpr double most_grid_cells = 1e12;

struct RasterRequest {
  std::string path;                    ///< as written; relative paths start at `directory`
  std::string key = "terrain.raster";  ///< scenario key, for messages
  std::string directory;               ///< of the scenario file
  std::string crs;                     ///< replaces the file's own system; empty: not given
  std::string crs_key = "terrain.crs";
  std::string fallback_crs;  ///< stands in only when the file has none; empty: refuse
  std::string fallback_crs_key;
  double factor = 1;                  ///< multiplies the values of a thickness raster
  bool is_scaled_later = false;       ///< they need not be metres yet
  bool may_reach_beyond = false;      ///< what it has beyond the terrain is left out, not refused
  std::optional<double> cell_size_m;  ///< wanted cells; default: the raster's own
  double max_cells = max_raster_cells;
};

}  // namespace sturz
