// SPDX-License-Identifier: Apache-2.0
/// Dams as they stand on the ground: a crest along a line, flat across, with even sides down to the
/// ground. What a cell becomes follows from the line and that cell alone, so any part of a raster
/// gets the same elevations.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/ground_structures.hpp"
#include "scenarios/scenario.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace sturz {

/// Of DamLine::foot_heights. On gentle ground a foot is met within the nearer; on ground nearly as
/// steep as the sides it never is.
inline constexpr double near_foot = 2.5, farthest_foot = 10;

/// The cells within so many metres of the box around some points.
Window window_around(const std::vector<Vec2>& points, double margin_m, const Grid&);

/// What raising a dam did to a raster.
struct DamFacts {
  std::size_t cells = 0;  ///< raised
  double highest_m = 0;   ///< most that a cell was raised
  double fill_m3 = 0;
  double crest_width_m = 0;  ///< as it stands: no narrower than a cell's diagonal
  double lowest_crest_m = 0, highest_crest_m = 0;  ///< elevation
  bool cut = false;                                ///< some side ends in the air, foot_heights away
  DamFacts& operator+=(const DamFacts&);
};

/// Elevation of the crest at each point of the line [m]. \pre the dam's numbers are fixed
std::vector<double> crest_of(const DamLine&, const DamSpec&);
/// Farthest that a dam's foot may be from its line [m].
double farthest_side(const DamLine&, const DamSpec&, double crest_width_m);
/// Width of a crest that leaves no gap between cells [m].
double standing_width(const DamSpec&, double cell_m);

/// Raises the cells of `ground` that lie below the dam. \param ground any part of a grid
/// \param crest_width_m across the line
DamFacts raise_dam(const DamLine&, const DamSpec&, double crest_width_m, Raster<double>& ground);

/// Which of a scene's dams.
enum class WhichDams { fixed, by_member, all };
DamFacts raise_dams(const GroundStructures&, const std::vector<DamSpec>& dams, WhichDams,
                    Raster<double>& ground);

}  // namespace sturz
