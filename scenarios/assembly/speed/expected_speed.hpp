// SPDX-License-Identifier: Apache-2.0
/// How fast the fastest part of a release may get: what particles' stiffness is made for.
#pragma once

#include "engine/laws/basal_resistance.hpp"
#include "scenarios/assembly/scene_plan.hpp"

#include <vector>

namespace sturz {

/// Of release.velocity_m_s [m/s].
double start_speed(const Scenario& numbers);

/// Of a mass point on the least friction that zones and rasters have anywhere [m/s].
double expected_speed(const Scenario& numbers, const std::vector<BasalResistance>& bed,
                      const ScenePlan& plan);

}  // namespace sturz
