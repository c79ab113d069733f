// SPDX-License-Identifier: Apache-2.0
/// When a member without numerics.end_time_s is stopped at the latest.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <string>

namespace sturz {

struct TimeCap {
  double end_time_s = 0;
  std::string reason;  ///< where it comes from, with its numbers
};

/// The longest way that the least friction allows, at a quarter of the slowest speed that the
/// flow is known for: the wave speed sqrt(g H) of the median release thickness H, with a
/// `basal.turbulent_coefficient_m_s2` or `basal.viscosity_pa_s` the even flow of that thickness on
/// a slope of five per cent. Rounded up to two digits; between one second and 1e5 s.
/// The scenario's own end time where it gives one; 120 s where the ground repeats itself.
/// \param thickness_m  H, vertical
/// \param density_kg_m3 bulk
TimeCap time_cap(const Scenario& numbers, const SceneInputs&, double thickness_m,
                 double density_kg_m3);

}  // namespace sturz
