// SPDX-License-Identifier: Apache-2.0
/// Polylines z(s) and their rounded versions, from which the landslide grounds are drawn.
#pragma once

#include "engine/terrain/raster.hpp"

#include <string>
#include <utility>
#include <vector>

namespace sturz::shapes {

/// Points of rising position; level beyond its ends.
using Profile = std::vector<std::pair<double, double>>;

double at(const Profile&, double s);

/// Mean of the profile over s - w .. s + w with the weight cos^2: no kinks, straight parts stay.
double rounded(const Profile&, double s, double half_width);

/// Smooth minimum: equals the smaller one where they differ by more than `blend`.
double smooth_min(double a, double b, double blend);

/// 1 on the axis, falling as the fourth power to 0 at |n| = half_width.
double lateral_share(double n, double half_width);

/// Scales a thickness so that its volume is exact.
/// \throws SetupError when no cell has any thickness (the cells are larger than the source)
void scale_to_volume(Raster<double>& thickness, double volume_m3, const std::string& shape);

/// Grid of a landslide ground: downhill = east, with the common false origin.
Grid landslide_grid(double s0, double s1, double half_width, double cell_m);
inline constexpr double origin_east_m = 500000, origin_north_m = 2900000;

}  // namespace sturz::shapes
