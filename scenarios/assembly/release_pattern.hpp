// SPDX-License-Identifier: Apache-2.0
/// From the release as its file gives it to the vertical thickness of a member.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

namespace sturz {

/// What release.thickness and release.floor make of the pattern, once for all members: thicknesses
/// normal to the slope become vertical, a floor is tapered. Says in the notes what it did, and both
/// volumes of a thickness that may have been meant either way.
///
/// Slope: the plane fitted to 3 x 3 cells of the working grid, as delivered.
/// \throws SetupError where a floor cannot be tapered
void shape_release(const Scenario&, SceneInputs&);

/// The member's vertical release thickness [m] on the working grid: the pattern times
/// release.thickness_m, or scaled to release.volume_m3. Every number must be fixed.
/// \throws SetupError when the source covers no cell
Raster<double> release_thickness(const ReleaseSpec&, const SceneInputs&);

/// A thickness of the same volume with a floor that comes out at the lower edge and the flanks.
///
/// In each connected part laplace(h) = -c * pattern with h = 0 at the edge, but no flux across
/// edges that face up the fall line (within 60 degrees), where a head scarp may stand; c keeps the
/// part's volume. This is the floor of constant curvature that the sloping local base level method
/// (Jaboyedoff et al. 2009) ends at, with a free head.
/// \param ground  elevation [m] on the same cells, or more of them
Raster<double> tapered(const Raster<double>& pattern, const Raster<double>& ground);

}  // namespace sturz
