// SPDX-License-Identifier: Apache-2.0
/// The files of a scene, loaded once and shared by all its members.
#pragma once

#include "engine/effects/bed_rasters.hpp"
#include "engine/terrain/terrain.hpp"
#include "scenarios/assembly/reach.hpp"
#include "scenarios/assets/assets.hpp"
#include "scenarios/ground_structures.hpp"
#include "scenarios/inflow/hydrograph.hpp"
#include "scenarios/input_identity.hpp"
#include "scenarios/observation/observed_event.hpp"
#include "scenarios/overlays/overlay.hpp"

#include <cstdint>
#include <memory>
#include <optional>
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

/// Part of a release that starts at one time.
struct ReleaseStart {
  double start_s = 0;  ///< without release.start_time_s
  /// Share of each cell of the release pattern that belongs to it, 0..1, on the pattern's cells.
  std::shared_ptr<const Raster<double>> share;
};

/// A named point (one corner) or line in map coordinates [m].
struct Gauge {
  std::string name;
  std::vector<Vec2> corners;
};

/// A number of the bed that a raster gives.
struct BedLayerInput {
  BedNumber number = BedNumber::friction;
  /// On the held cells, NaN where the raster says nothing.
  std::shared_ptr<const Raster<double>> values;
  /// Of its values where the energy line comes, whatever is held; NaN where it says nothing there.
  double least = 0, most = 0, mean = 0;
};

struct SceneInputs {
  /// As delivered (bed or pre-failure), NaN nodata: the part of the working grid that is held.
  std::shared_ptr<const Raster<double>> elevation;
  Grid whole;  ///< the working grid where only a part is held; empty: all of it is
  /// Pattern on cells of the working grid, nothing beyond.
  std::shared_ptr<const Raster<double>> release;
  ReleasePattern pattern = ReleasePattern::cover;
  /// Share of each cell of `release` that the source covers, 0..1; null: all of every cell > 0.
  std::shared_ptr<const Raster<double>> release_cover;
  /// By ascending start; empty: all of it starts at once.
  std::vector<ReleaseStart> release_starts;
  /// Share of each cell inside the outline of fluid.pool, 0..1, on cells of the working grid,
  /// nothing beyond. Null: no outline is given.
  std::shared_ptr<const Raster<double>> pool;
  std::vector<InflowSource> inflow;  ///< in the order of the scenario
  std::vector<Gauge> gauge_points, gauge_lines;
  /// The surface over `elevation`, and the same averaged to the columns' spacing where that is
  /// coarser; null: each member makes its own. See scenarios/assembly/ground.hpp.
  std::shared_ptr<const Terrain> ground, column_ground;
  /// Zone of the bed per held cell: 0 none, k the k-th of basal.zones; null: no zones.
  std::shared_ptr<const Raster<std::uint8_t>> zones;
  GroundStructures structures;  ///< dams and buildings; those of all members stand in `elevation`
  std::vector<BedLayerInput> bed_layers;  ///< of basal.rasters, in their order; mostly none
  /// What can be taken of the bed, on cells of the working grid: share of erosion.depth_m, or depth
  /// where erosion.depth_raster gives it [m]; nothing beyond. Null: the same everywhere.
  std::shared_ptr<const Raster<double>> bed_supply;
  /// Rings to be drawn in the terrain's system [m]: of hazard.observed_polygon and of what
  /// `observation` outlines; empty: none.
  std::vector<std::vector<Vec2>> observed;
  /// What members are scored against; null: the scene has no `observation`.
  std::shared_ptr<const ObservedEvent> event;
  /// What may be hit, on cells of `hazard_grid`; null: the scene has no `assets`.
  std::shared_ptr<const Assets> assets;
  std::vector<Overlay> overlays;  ///< what the page draws over its maps
  Grid hazard_grid;               ///< the maps' common grid
  double source_area_m2 = 0;      ///< exact area of the polygons (or of cells > 0)
  double source_volume_m3 =
      0;  ///< exact volume of the source before resampling; 0: follows from thickness_m
  /// Volume of the source with its thickness normal to the slope, over that with the same numbers
  /// read vertically: at least 1. See scenarios/assembly/release_pattern.hpp.
  double normal_over_vertical = 1;
  std::vector<std::string> notes;     ///< what was reprojected, resampled, corrected, by how much
  std::vector<std::string> warnings;  ///< what was guessed, and what cannot be right
  std::vector<InputIdentity> identities;  ///< of every file, in the order of the scenario's blocks
  /// Hash of ground and pattern where the release lies; the same whatever window of the terrain was
  /// read.
  std::string release_hash;
  /// How far the mass can come, of the whole scene and whatever is held; empty: not looked at.
  std::optional<Reach> reach;
  Window first_window;  ///< of level 0, see larger_window
  int level = 0;        ///< of what is held

  const Grid& terrain_grid() const { return whole.n_cols > 0 ? whole : elevation->grid; }
  Window held() const { return window_of(elevation->grid, terrain_grid()); }
};

}  // namespace sturz
