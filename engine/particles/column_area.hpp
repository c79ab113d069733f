// SPDX-License-Identifier: Apache-2.0
/// Map area that a depth-averaged column stands for, by what it sees of its neighbours.
#pragma once

#include <algorithm>

namespace sturz {

/// Support radius over the mean distance of columns.
constexpr double radius_per_distance = 4;

/// Square of the mean distance, or what the volume covers at its thickness where columns lie
/// farther apart than they look [m2]. At the edge of a mass up to twice too large: half of what a
/// column looks at is empty there. The field "area_share" makes up for it.
/// \param support_radius  [m]  \param upright  vertical part of the ground's normal [-]
/// \param volume  [m3]  \param thickness  normal to the ground [m]
inline double column_area(double support_radius, double upright, double volume, double thickness) {
  const double distance = support_radius / radius_per_distance;
  const double square = distance * distance * upright;
  return thickness > 0 ? std::max(square, volume * upright / thickness) : square;
}

}  // namespace sturz
