// SPDX-License-Identifier: Apache-2.0
/// The files of a scene, loaded once and shared by all its members.
#pragma once

#include "engine/terrain/terrain.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sturz {

/// How the release pattern raster is to be read.
enum class ReleasePattern {
  cover,  ///< share of each cell that the source covers, 0..1; times release.thickness_m or scaled
          ///< to volume_m3
  thickness,  ///< vertical thickness [m]; scaled when release.volume_m3 is given (once
              ///< shape_release has seen it: before, as release.thickness says)
};

struct SceneInputs {
  std::shared_ptr<const Raster<double>>
      elevation;  ///< working grid, as delivered (bed or pre-failure), NaN nodata
  std::shared_ptr<const Raster<double>>
      release;  ///< pattern on the same grid, zeros outside the source
  ReleasePattern pattern = ReleasePattern::cover;
  /// The surface over `elevation`, and the same averaged to the columns' spacing where that is
  /// coarser; null: each member makes its own. See scenarios/assembly/ground.hpp.
  std::shared_ptr<const Terrain> ground, column_ground;
  /// Zone of the bed per cell of the same grid: 0 none, k the k-th of basal.zones; null: no zones.
  std::shared_ptr<const Raster<std::uint8_t>> zones;
  Grid hazard_grid;           ///< the maps' common grid
  double source_area_m2 = 0;  ///< exact area of the polygons (or of cells > 0)
  double source_volume_m3 =
      0;  ///< exact volume of the source before resampling; 0: follows from thickness_m
  /// Volume of the source with its thickness normal to the slope, over that with the same numbers
  /// read vertically: at least 1. See scenarios/assembly/release_pattern.hpp.
  double normal_over_vertical = 1;
  std::vector<std::string> notes;  ///< what was reprojected, resampled, corrected, by how much
  std::vector<std::pair<std::string, std::string>>
      checksums;  ///< input file -> hash, for the manifest
};

}  // namespace sturz
