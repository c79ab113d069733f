// SPDX-License-Identifier: Apache-2.0
/// Releases that are possible but hardly meant.
#pragma once

#include "engine/terrain/raster.hpp"

#include <span>
#include <string>

namespace sturz {

/// Refuses what is a mask and not a thickness: every value above zero is 255, as drawing programs
/// write it.
/// \param factor release.thickness_factor; another one than 1 says that the values are meant
/// \throws SetupError naming `label`
void refuse_mask(std::span<const double> thickness, double factor, const std::string& label);

/// A sentence where the mean thickness is more than half the square root of the area, ten times
/// what slides have: centimetres or a factor forgotten. Else empty.
std::string thickness_doubt(double volume_m3, double area_m2, double largest_m, double factor,
                            const std::string& label);

/// A sentence where cells of the release lie nearer than ten cells to the edge of the terrain: mass
/// leaves there at once. Else empty.
/// \param pattern on cells of `terrain`, or of a part of it
std::string edge_doubt(const Raster<double>& pattern, const Grid& terrain,
                       const std::string& label);

}  // namespace sturz
