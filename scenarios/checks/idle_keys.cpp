// SPDX-License-Identifier: Apache-2.0
#include "scenarios/checks/idle_keys.hpp"

#include "scenarios/schema/schema.hpp"

#include <algorithm>

namespace sturz {
namespace {

std::vector<std::string> idle_paths(const Scenario& s, bool depth_averaged, bool friction_inside) {
  if (s.formulation == Formulation::discrete) {
    std::vector<std::string> paths{"grains.friction_cone",
                                   "grains.pore_pressure_inside",
                                   "grains.friction.static",
                                   "grains.friction.dynamic",
                                   "grains.friction.inertial_number_scale",
                                   "grains.friction_angle_deg",
                                   "grains.cohesion_pa",
                                   "numerics.sound_speed_factor",
                                   "numerics.adaptive_sound_speed",
                                   "numerics.density_diffusion",
                                   "numerics.artificial_viscosity",
                                   "numerics.courant",
                                   "numerics.spacing_m"};
    if (s.grains && s.grains->discrete && s.grains->discrete->diameter_m)
      paths.emplace_back("grains.diameter_m");
    return paths;
  }
  // The bed's friction is the grains', and a liquid by itself has none to take it.
  if (s.fluid && !s.grains)
    return {"basal.friction_coefficient", "basal.pore_pressure_ratio", "basal.cohesion_pa",
            "basal.zones", "numerics.artificial_viscosity"};
  if (!depth_averaged) {
    // Without rate dependence the inertial number, and with it the diameter, has no say; collisions
    // and contacts have, and drag.
    const bool drags = s.fluid && !(s.coupling && s.coupling->drag_diameter_m);
    if (s.grains && s.grains->friction_angle_deg && !s.grains->states && !drags)
      return {"grains.diameter_m"};
    return {};
  }
  std::vector<std::string> paths{"grains.friction_cone",
                                 "grains.pore_pressure_inside",
                                 "grains.cohesion_pa",
                                 "grains.poisson_ratio",
                                 "basal.restitution",
                                 "numerics.sound_speed_factor",
                                 "numerics.adaptive_sound_speed",
                                 "numerics.density_diffusion",
                                 "numerics.artificial_viscosity"};
  const bool two = has_two_phases(s.mixture);
  const bool settles = two && s.mixture->drag_law == PhaseDragLaw::settling;
  if (!settles) paths.emplace_back("grains.diameter_m");
  if (two)
    for (const char* path : {"mixture.critical_solid_fraction", "mixture.compressibility",
                             "mixture.stress_offset_pa", "mixture.shear_grain_diameter_m"})
      paths.emplace_back(path);
  if (settles)
    for (const char* path : {"mixture.permeability_m2", "mixture.permeability_fraction"})
      paths.emplace_back(path);
  // Lateral pressure takes the slow internal friction only.
  paths.emplace_back("grains.friction.dynamic");
  paths.emplace_back("grains.friction.inertial_number_scale");
  if (s.grains && !friction_inside && !asks_for_internal_friction(s.grains->earth_pressure)) {
    paths.emplace_back("grains.friction.static");
    paths.emplace_back("grains.friction_angle_deg");
  }
  return paths;
}

/// Those of the paths that the scene sets to something else than their default.
std::vector<std::string> given_of(const Scenario& s, const std::vector<std::string>& paths) {
  Scenario bare;
  bare.grains.emplace().friction.emplace();
  bare.mixture.emplace();
  std::vector<std::string> given;
  for (const KeyInfo& key : schema()) {
    if (std::find(paths.begin(), paths.end(), key.path) == paths.end()) continue;
    const KeyValue value = key.get(s);
    if (!std::holds_alternative<std::monostate>(value) && value != key.get(bare))
      given.push_back(key.path);
  }
  return given;
}

}  // namespace

std::vector<std::string> idle_keys(const Scenario& s, bool depth_averaged, bool friction_inside) {
  return given_of(s, idle_paths(s, depth_averaged, friction_inside));
}

std::vector<std::string> idle_layer_keys(const Scenario& s) {
  if (s.erosion) return {};
  return given_of(s, {"hazard.eroded_depth_m"});
}

}  // namespace sturz
