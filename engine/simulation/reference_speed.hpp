// SPDX-License-Identifier: Apache-2.0
/// The speed to expect of a mass on a terrain: friction-slowed mass points from the release.
#pragma once

#include "engine/particles/release.hpp"
#include "engine/terrain/terrain.hpp"

namespace sturz {

/// Largest speed [m/s] of frictional mass points (curvature included) that start at rest (or with
/// `initial_speed`) from a regular subset of the release, never less than sqrt(g H) of the greatest
/// release thickness H. This is the energy line followed along real paths, so it is sharper than
/// the straight-line bound.
///
/// The points slide on the ground smoothed over one cell, with centripetal reaction; where they
/// would detach they stay on it, but never get faster than gravity and friction allow. A point
/// ends at rest, where it leaves the known ground, or at end_time_s.
/// \param effective_friction mu_b (1 - r_u) [-], negative counts as zero
/// \param initial_speed       down the steepest slope [m/s]
double reference_speed(const Terrain& terrain, const Release& release, double effective_friction,
                       double initial_speed, double end_time_s);

/// Time [s] until the last of a few of these points ends: an estimate of how long a mass moves.
double time_to_rest(const Terrain& terrain, const Release& release, double effective_friction,
                    double initial_speed, double end_time_s);

}  // namespace sturz
