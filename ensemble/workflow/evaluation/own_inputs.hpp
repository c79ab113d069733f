// SPDX-License-Identifier: Apache-2.0
/// How far one member can come by its own numbers, where the inputs say it of all members together.
#pragma once

#include "io/site/terrain_window.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <optional>

namespace sturz::workflow {

/// The reach of one member's numbers, from which its stop rule and its longest time follow: all
/// that `sturz run` loads otherwise for the scene of these numbers, but for how much ground is
/// held. \return nothing where that takes more than the held ground, or hangs together with rasters
/// of the
///   bed, dams or buildings: load the scene of these numbers then
std::optional<FirstGround> ground_of_member(const Scenario& numbers, const SceneInputs& of_all);

}  // namespace sturz::workflow
