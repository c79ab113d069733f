// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/speed/expected_speed.hpp"

#include "engine/simulation/reference_speed.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

double start_speed(const Scenario& s) {
  const auto& v0 = s.release.velocity_m_s;
  return std::sqrt(v0[0] * v0[0] + v0[1] * v0[1] + v0[2] * v0[2]);
}

double expected_speed(const Scenario& s, const std::vector<BasalResistance>& bed,
                      const ScenePlan& plan) {
  double least_friction = bed[0].effective_friction();
  for (const BasalResistance& b : bed) {
    const double mu = plan.rasters.range(b, BedNumber::friction).first;
    const double pore_pressure = plan.rasters.range(b, BedNumber::pore_pressure).second;
    least_friction = std::min(least_friction, mu * (1 - pore_pressure));
  }
  return reference_speed(plan.bed, plan.release, least_friction, start_speed(s),
                         plan.end.end_time_s);
}

}  // namespace sturz
