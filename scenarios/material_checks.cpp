// SPDX-License-Identifier: Apache-2.0
// Which material blocks go together.
#include "scenarios/combination_checks.hpp"
#include "scenarios/distribution_check.hpp"
#include "scenarios/number_text.hpp"

namespace sturz {

void check_material(const Scenario& s, std::vector<Problem>& problems) {
  if (!s.grains) {
    problems.push_back({"grains", "grains (missing: nothing would move). Add a grains block."});
    return;
  }
  const auto& g = *s.grains;
  if (g.friction && g.friction_angle_deg)
    problems.push_back({"grains.friction_angle_deg",
                        "grains.friction_angle_deg (grains.friction is there too). Keep one of "
                        "them."});
  if (!g.friction && !g.friction_angle_deg)
    problems.push_back({"grains",
                        "grains (no internal friction). Add grains.friction or "
                        "grains.friction_angle_deg."});
  if (!g.friction) return;
  const double most_static = support(g.friction->static_coefficient).second;
  const double least_dynamic = support(g.friction->dynamic_coefficient).first;
  if (most_static > least_dynamic)  // friction that falls with the shear rate is ill-posed
    problems.push_back({"grains.friction.dynamic",
                        "grains.friction.dynamic = " + number_text(least_dynamic) +
                            " (must be >= grains.friction.static = " + number_text(most_static) +
                            "). Friction may not fall with the shear rate."});
}

}  // namespace sturz
