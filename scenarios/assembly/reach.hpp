// SPDX-License-Identifier: Apache-2.0
/// How far the mass of a scene can come at most: the energy line of the least friction, laid over
/// the ground. It says which part of a large raster is worth reading, and bounds the time of a run.
#pragma once

#include "engine/terrain/raster.hpp"

#include <functional>
#include <string>
#include <utility>

namespace sturz {

struct Scenario;
struct SceneInputs;
struct Uncertain;

/// Elevations [m] of a window of the working grid, on that window's own grid.
using ReadGround = std::function<Raster<double>(const Window&)>;

/// The energy line of a scene: it falls from `top_m` by `friction` per metre of way, in every
/// direction from the release.
struct EnergyLine {
  Window release;       ///< cells with mass, tight
  double top_m = 0;     ///< highest surface of the release, and the height of its first speed
  double friction = 0;  ///< least effective coefficient that is drawn in any member, >= 0
};

/// Where the ground lies under the energy line, connected with the release.
struct Reach {
  Window window;        ///< bounding box, the release in it
  double lowest_m = 0;  ///< lowest ground there
  double length_m = 0;  ///< longest straight way out from the release, its own extent added
  double friction = 0;  ///< of the line
  bool cut = false;     ///< larger than most_cells: the window is what was looked at until then
  /// Height of the line over the ground where it meets the raster's end, 0 where it does not [m].
  double above_end_m = 0;
  std::string end;  ///< which: "north", "east", "south", "west"
  /// The same at cells without elevation inside the raster.
  double above_unknown_m = 0;
};

/// Values that a key may get: the support, of unbounded distributions four standard deviations.
std::pair<double, double> drawn_range(const Uncertain&);

/// Of all members together. \pre terrain grid and release are loaded
/// \param surface_m highest ground below the release
EnergyLine energy_line(const Scenario&, const SceneInputs&, double surface_m);

/// More cells than this are not looked at.
inline constexpr double most_reach_cells = 9e6;

/// Looks at no more of the ground than needed: a window around the release that grows where the
/// line goes on. The answer depends on raster and line alone.
Reach reach_of(const EnergyLine&, const Grid& whole, const ReadGround&,
               double most_cells = most_reach_cells);

/// Cells around a reach that a mass may need besides: what spreads beyond the line, stencils.
Window with_margin(const Window&, const Grid& whole, double spacing_m);

/// The window of level 0, 1, 2, ...: each twice as wide as the one before, the last ones the whole.
Window larger_window(const Window& first, int level, const Grid& whole);

}  // namespace sturz
