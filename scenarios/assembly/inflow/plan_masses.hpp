// SPDX-License-Identifier: Apache-2.0
/// Everything that moves in a member: the release in its parts, what enters later, and how long
/// that takes.
#pragma once

#include "scenarios/assembly/scene_plan.hpp"

#include <cstdint>
#include <functional>

namespace sturz {

/// Fills release, later columns and inflow of a plan whose ground, formulation and density are
/// known. \param thickness of the whole release [m]  \param density of a solid fraction [kg/m^3]
void plan_masses(const Scenario& numbers, const SceneInputs&, const Raster<double>& thickness,
                 std::int64_t member, const std::function<double(double solid_fraction)>& density,
                 ScenePlan&);

/// The time counts from when the last of the mass has entered, but for a given end.
void plan_end(const Scenario& numbers, const SceneInputs&, ScenePlan&);

/// Of release and inflow where they fall to the lowest ground that they may reach [J].
double available_energy(const Scenario& numbers, const SceneInputs&, const ScenePlan&);

}  // namespace sturz
