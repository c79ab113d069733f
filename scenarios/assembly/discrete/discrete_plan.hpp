// SPDX-License-Identifier: Apache-2.0
/// From `grains.discrete` to grains on the bed and their contacts.
#pragma once

#include "engine/laws/basal_resistance.hpp"
#include "engine/particles/grain_packing.hpp"
#include "scenarios/scenario.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz {

struct ScenePlan;

/// The scene with the spacing that its grains have: one grain a cube, in the place of
/// numerics.spacing_m. As it is in every other formulation.
Scenario with_grain_spacing(const Scenario& numbers);

/// Makes the grains of a discrete scene larger, as a longer spacing makes particles; others stay.
void scale_grains(Scenario& numbers, double factor);

/// \pre formulation: discrete
GrainPacking grain_packing(const Scenario& numbers, std::int64_t member);

/// \throws SetupError where a release holds more grains than a machine's memory
void require_countable_grains(const Scenario& numbers, const Raster<double>& thickness);

/// Contacts of the grains, after the release and the expected speed are known.
void plan_discrete(const Scenario& numbers, std::vector<BasalResistance> bed, ScenePlan& plan);

/// "24324 grains of 3 m (2.7-3.3), set down at a fill of 0.6; E 2.1e9 of 5e10 Pa, ..."
std::string discrete_text(const Scenario& numbers, const ScenePlan& plan);

}  // namespace sturz
