// SPDX-License-Identifier: Apache-2.0
/// Depth-averaged flow (DAN3D family: McDougall & Hungr 2004; AvaFrame com1DFA): each particle is
/// a column of constant density that slides on the ground. No stress, no layers, no sound waves.
#pragma once

#include "engine/effects/columns/settings.hpp"
#include "engine/effects/step.hpp"

#include <memory>
#include <span>

namespace sturz {

struct ColumnFlow;

/// Fields "thickness" (along the ground's normal [m]), "support_radius" [m], "normal_gravity"
/// [m/s^2], "centripetal_momentum" (of curvature met and not yet borne by the ground, per mass
/// [m/s]), "ground", "area_share", "velocity_before" and, where K varies, "earth_pressure". Adds
/// cells, gather, sweep, bed and motion; the columns are put on the ground and their velocities
/// made tangent. \param thickness of each column along the vertical at release [m] \param covered
/// share of each column's lattice cell that the source covers; empty: all of it
/// \return what the passes share, for a family that couples two sets of columns
std::shared_ptr<ColumnFlow> add_depth_averaged(Step&, State&, std::size_t set,
                                               const DepthAveragedSettings&,
                                               std::span<const double> thickness,
                                               std::span<const double> covered = {});

/// Memory of cells, records and sums of the sweep [bytes per column].
std::size_t column_bytes_per_particle();

}  // namespace sturz
