// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/speed/expected_speed.hpp"

#include "engine/core/constants.hpp"
#include "engine/simulation/reference_speed.hpp"
#include "scenarios/assembly/liquid/liquid_plan.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

double start_speed(const Scenario& s) {
  const auto& v0 = s.release.velocity_m_s;
  return std::sqrt(v0[0] * v0[0] + v0[1] * v0[1] + v0[2] * v0[2]);
}

double expected_speed(const Scenario& s, const std::vector<BasalResistance>& bed,
                      const ScenePlan& plan) {
  if (is_liquid_alone(s)) {
    // What the yield stress bears of the thickest part; viscosity brakes no less.
    const double load = plan.bulk_density_kg_m3 * standard_gravity * plan.release.max_thickness_m;
    return reference_speed(plan.bed, plan.release, liquid_law(*s.fluid).yield_stress / load,
                           start_speed(s), plan.end.end_time_s);
  }
  double least_friction = bed[0].effective_friction();
  for (const BasalResistance& b : bed) {
    const double mu = plan.rasters.range(b, BedNumber::friction).first;
    const double pore_pressure = plan.rasters.range(b, BedNumber::pore_pressure).second;
    least_friction = std::min(least_friction, mu * (1 - pore_pressure));
  }
  if (s.fluid) least_friction *= weight_on_grains(s);
  return reference_speed(plan.bed, plan.release, least_friction, start_speed(s),
                         plan.end.end_time_s);
}

}  // namespace sturz
