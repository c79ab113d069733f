// SPDX-License-Identifier: Apache-2.0
// What grains one by one do not know, and what only they know.
#include "scenarios/checks/combination_checks.hpp"

#include <string>

namespace sturz {
namespace {

using Problems = std::vector<Problem>;

void refuse(bool given, const char* path, const char* other, Problems& problems) {
  if (!given) return;
  problems.push_back({path, std::string(path) +
                                " (formulation is discrete, whose grains know contacts only). "
                                "Remove it or set formulation: " +
                                other + "."});
}

}  // namespace

void check_discrete(const Scenario& s, Problems& problems) {
  if (s.formulation != Formulation::discrete) {
    if (s.grains && s.grains->discrete)
      problems.push_back({"grains.discrete", "grains.discrete (formulation is " +
                                                 std::string(to_string(s.formulation)) +
                                                 "; only discrete knows it). Remove it or set "
                                                 "formulation: discrete."});
    return;
  }
  constexpr const char *columns = "depth_averaged", *stress = "full_stress";
  const auto& b = s.basal;
  refuse(!s.material.empty(), "material", columns, problems);
  refuse(s.grains && s.grains->states, "grains.states", stress, problems);
  refuse(s.grains && asks_for_internal_friction(s.grains->earth_pressure), "grains.earth_pressure",
         columns, problems);
  refuse(s.mixture.has_value(), "mixture", columns, problems);
  refuse(s.fluid.has_value(), "fluid", stress, problems);
  // That of a material goes with it: the file does not hold it by itself.
  refuse(b.turbulent_coefficient_m_s2 && s.material.empty(), "basal.turbulent_coefficient_m_s2",
         columns, problems);
  refuse(b.viscosity_pa_s.has_value(), "basal.viscosity_pa_s", columns, problems);
  refuse(b.yield_stress_pa.has_value(), "basal.yield_stress_pa", columns, problems);
  refuse(b.samosat.has_value(), "basal.samosat", columns, problems);
  refuse(zone_with_turbulence(b).has_value(), "basal.zones", columns, problems);
  refuse(!b.rasters.turbulent_coefficient_m_s2.path.empty(),
         "basal.rasters.turbulent_coefficient_m_s2", columns, problems);
  refuse(s.erosion.has_value(), "erosion", columns, problems);
  refuse(!s.inflow.empty(), "inflow", columns, problems);
  refuse(s.release.start_time_s.has_value(), "release.start_time_s", columns, problems);
  refuse(!s.release.start_time_attribute.empty(), "release.start_time_attribute", columns,
         problems);
}

}  // namespace sturz
