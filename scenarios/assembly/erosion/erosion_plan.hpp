// SPDX-License-Identifier: Apache-2.0
/// The bed that a flow takes along: numbers and supply of one member.
#pragma once

#include "engine/effects/columns/mixture_settings.hpp"
#include "engine/effects/erosion/settings.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <string>

namespace sturz {

/// What does not follow from `erosion` alone.
struct ErosionPlace {
  Grid ground;                       ///< that columns feel, the whole of it or one period
  double flow_density = 1;           ///< bulk [kg/m^3]
  std::vector<BasalResistance> bed;  ///< by zone
  ZoneMap zones;
  const MixtureSettings* mixture = nullptr;  ///< of the flow
  BedRasters rasters = {};                   ///< over the zones
};

/// \pre the scene has `erosion`
ErosionSettings plan_erosion(const Scenario& numbers, const SceneInputs&, const ErosionPlace&);

/// Law, supply and density in words, for `describe`.
std::string erosion_text(const ErosionSpec&);

}  // namespace sturz
