// SPDX-License-Identifier: Apache-2.0
/// The rasters of `basal.rasters` as a member has them, and what they mean for estimates.
#pragma once

#include "engine/effects/bed_rasters.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <utility>

namespace sturz {

/// Values of all held cells with the member's factors; empty without rasters.
BedRasters plan_bed_rasters(const Scenario& numbers, const SceneInputs&);

/// The scene with the mean of each raster, where the flow may come, in the place of basal's number:
/// for estimates of a whole that has one number only.
Scenario with_typical_bed(Scenario numbers, const SceneInputs&);

/// Least and most that a number of the bed is anywhere and in any member: basal, zones, rasters.
std::pair<double, double> drawn_bed_range(const Scenario&, const SceneInputs&, BedNumber);

}  // namespace sturz
