// SPDX-License-Identifier: Apache-2.0
/// The lip at the lower end of a release: ground that stands above its floor along the fall line.
#pragma once

#include "engine/terrain/raster.hpp"

namespace sturz {

struct ReleaseLip {
  double length_m = 0;  ///< of the lower edge where the ground outside stands above the floor
  double height_m = 0;  ///< mean over that length
  double slope = 0;     ///< mean slope of the ground under the release, rise over run
  /// What it takes to push over the lip at rest, rho g height^2 / 2 per width, over what drives
  /// the release, rho g V (slope - friction); 0 without a lip or a drive.
  double share_of_drive = 0;
};

/// \param ground     as delivered [m]
/// \param thickness  vertical [m], on the same cells or fewer
/// \param dug_out    the floor is ground - thickness, else the ground itself
/// \param friction   effective friction coefficient of the bed
ReleaseLip release_lip(const Raster<double>& ground, const Raster<double>& thickness, bool dug_out,
                       double friction);

}  // namespace sturz
