// SPDX-License-Identifier: Apache-2.0
/// What was observed of one event, read from its files and laid on the cells of the maps. Holds
/// all that a score needs besides members, so that several events can be scored side by side.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"

#include <optional>
#include <vector>

namespace sturz {

/// A number that was measured, in SI.
struct Measured {
  double value = 0, sd = 0;
};

/// Mapped polygons, the overlap of features counted once.
struct ObservedArea {
  Raster<double> cover;  ///< share of each cell 0..1, on the cells of the maps around the polygons
  std::vector<std::vector<Vec2>> outer;  ///< closed outer rings in the maps' system [m]
  double sd_m = 0;                       ///< of the outline, across it
};

struct ObservedThickness {
  Raster<double> value;     ///< on cells of the maps [m]; NaN: not measured, or not to be compared
  bool net_change = false;  ///< rise of the ground; else thickness of what lies there
  double sd_m = 0;
};

struct ObservedFront {
  double time_s = 0;
  std::optional<double> distance_m;  ///< from the origin, or along the thalweg; else at `point`
  Vec2 point = Vec2::Zero();
  std::optional<double> sd_m, sd_s;  ///< one of them: of the place at the time, or the other way
};

struct ObservedSpeed {
  Vec2 point = Vec2::Zero();
  Measured speed_m_s;
};

struct ObservedEvent {
  std::optional<ObservedArea> outline;  ///< passed over at any time
  std::optional<ObservedArea> deposit;  ///< at rest
  std::optional<ObservedThickness> thickness;
  std::optional<Vec2> farthest;
  double farthest_sd_m = 0;
  std::optional<Measured> runout_m, h_over_l, com_travel_m, volume_m3, area_m2;
  std::vector<ObservedFront> fronts;
  std::vector<ObservedSpeed> speeds;
  std::vector<Vec2> thalweg;   ///< corners down the path; empty: distances are straight
  Vec2 origin = Vec2::Zero();  ///< centre of mass of the source on the map
  /// Thickness from which on a cell counts as covered [m]; members of full stress that were given
  /// no threshold take at least a tenth of their spacing.
  double threshold_m = 0.1;
  bool threshold_given = false;
  double spacing_m = 0;
};

}  // namespace sturz
