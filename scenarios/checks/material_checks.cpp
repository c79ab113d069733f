// SPDX-License-Identifier: Apache-2.0
// Which material keys go together, and which formulation knows them.
#include "scenarios/checks/combination_checks.hpp"
#include "scenarios/checks/distribution_check.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/schema/raster_fields.hpp"
#include "scenarios/schema/value_text.hpp"

#include <algorithm>

namespace sturz {
namespace {

using Problems = std::vector<Problem>;

/// Isotropic columns slide on the bed and know no friction inside.
bool needs_internal_friction(const Scenario& s) {
  return s.formulation == Formulation::full_stress || s.fluid ||
         asks_for_internal_friction(s.grains->earth_pressure);
}

void check_grains(const Scenario& s, Problems& problems) {
  if (!s.grains) {
    if (!s.fluid)
      problems.push_back({"grains",
                          "grains (missing: nothing would move). Add a grains block or a material, "
                          "or a fluid."});
    return;
  }
  const auto& g = *s.grains;
  if (g.friction && g.friction_angle_deg)
    problems.push_back({"grains.friction_angle_deg",
                        "grains.friction_angle_deg (grains.friction is there too). Keep one of "
                        "them."});
  if (!g.friction && !g.friction_angle_deg && needs_internal_friction(s))
    problems.push_back(
        {"grains",
         "grains (no internal friction, which " +
             std::string(s.formulation == Formulation::full_stress || s.fluid
                             ? "full_stress needs). "
                             : "grains.earth_pressure: " +
                                   std::string(to_string(s.grains->earth_pressure)) + " needs). ") +
             "Add grains.friction or grains.friction_angle_deg."});
  if (!g.friction) return;
  const double most_static = support(g.friction->static_coefficient).second;
  const double least_dynamic = support(g.friction->dynamic_coefficient).first;
  if (most_static > least_dynamic)  // friction that falls with the shear rate is ill-posed
    problems.push_back({"grains.friction.dynamic",
                        "grains.friction.dynamic = " + number_text(least_dynamic) +
                            " (must be >= grains.friction.static = " + number_text(most_static) +
                            "). Friction may not fall with the shear rate."});
}

/// "key = value", as the file would write it.
std::string shown(const Scenario& s, const char* path) {
  return std::string(path) + " = " + value_text(find_key(path)->get(s));
}

/// What grains that separate need to be told apart by.
void check_states(const Scenario& s, Problems& problems) {
  if (!s.grains || !s.grains->states) return;
  const GrainStatesSpec& states = *s.grains->states;
  if (s.formulation == Formulation::depth_averaged)
    problems.push_back({"grains.states",
                        "grains.states (formulation is depth_averaged; only full_stress knows it). "
                        "Remove it or set formulation: full_stress."});
  const double densest = support(s.grains->solid_fraction).second;
  if (!states.max_fraction) return;
  const double least = support(*states.max_fraction).first;
  // The release is dense: it must fit under the packing that no pressure can close.
  if (least < std::max(0.60, densest) + 0.02)
    problems.push_back({"grains.states.max_fraction",
                        "grains.states.max_fraction = " + number_text(least) +
                            " (must be at least 0.02 above grains.solid_fraction = " +
                            number_text(densest) + ", and 0.62). Raise it or leave it out."});
}

/// Inside the mass there is one ratio of pore pressure, that of `basal` itself.
void check_pores_inside(const Scenario& s, Problems& problems) {
  const char* const path = "grains.pore_pressure_inside";
  if (!s.grains || !s.grains->pore_pressure_inside ||
      s.formulation == Formulation::depth_averaged || s.formulation == Formulation::discrete)
    return;
  const auto refuse = [&](const std::string& why, const std::string& cure) {
    problems.push_back({path, shown(s, path) + " (" + why + "). " + cure});
  };
  if (s.mixture)
    return refuse("mixture is there too, which computes the pore pressure", "Remove it.");
  const std::string one = "; inside, one ratio holds for the whole scene";
  const std::string cure = "Keep one of them; basal.pore_pressure_ratio acts in both places.";
  if (!s.basal.rasters.pore_pressure_ratio.path.empty())
    return refuse("basal.rasters.pore_pressure_ratio changes it from place to place" + one, cure);
  for (std::size_t i = 0; i < s.basal.zones.size(); ++i)
    if (s.basal.zones[i].pore_pressure_ratio)
      return refuse("basal.zones[" + std::to_string(i) +
                        "].pore_pressure_ratio changes it from place to place" + one,
                    cure);
}

/// Columns have a drag and a lateral pressure of their own; particles get both from their stress.
void check_formulation(const Scenario& s, Problems& problems) {
  if (s.formulation != Formulation::full_stress) return;
  const auto refuse = [&](bool given, const char* path) {
    if (given)
      problems.push_back({path, shown(s, path) +
                                    " (formulation is full_stress; only depth_averaged knows it). "
                                    "Remove it or set formulation: depth_averaged."});
  };
  const auto& b = s.basal;
  if (!s.material.empty() && !s.fluid)
    problems.push_back({"material", shown(s, "material") +
                                        " (formulation is full_stress; its priors are those of "
                                        "columns). Remove it or set formulation: "
                                        "depth_averaged."});
  refuse(s.grains && asks_for_internal_friction(s.grains->earth_pressure), "grains.earth_pressure");
  // That of a material goes with it: the file does not hold it by itself.
  refuse(b.turbulent_coefficient_m_s2 && s.material.empty(), "basal.turbulent_coefficient_m_s2");
  refuse(b.viscosity_pa_s.has_value(), "basal.viscosity_pa_s");
  refuse(b.yield_stress_pa.has_value(), "basal.yield_stress_pa");
  if (const auto zone = zone_with_turbulence(b))
    problems.push_back(
        {"basal.zones", "basal.zones[" + std::to_string(*zone) +
                            "].turbulent_coefficient_m_s2 (formulation is full_stress; only "
                            "depth_averaged knows it). Remove it or set formulation: "
                            "depth_averaged."});
}

/// Pore pressure is computed where there is a mixture, so nothing else may set it.
void check_mixture(const Scenario& s, Problems& problems) {
  if (!s.mixture) return;
  const MixtureSpec& wet = *s.mixture;
  const auto refuse = [&](bool given, const char* path, const char* why) {
    if (given) problems.push_back({path, shown(s, path) + why});
  };
  if (s.formulation == Formulation::full_stress)
    problems.push_back({"mixture",
                        "mixture (formulation is full_stress; only depth_averaged knows "
                        "it). Remove it or set formulation: depth_averaged."});
  refuse(
      !s.material.empty(), "material",
      " (mixture is there too; a material's friction is that of the whole flow with its water, a "
      "mixture's that of the grains alone). Keep one of them.");
  refuse(s.basal.pore_pressure_ratio != Uncertain(0), "basal.pore_pressure_ratio",
         " (mixture is there too, which computes the pore pressure). Remove it; "
         "mixture.initial_pressure_ratio sets the pressure at the start.");
  refuse(s.basal.viscosity_pa_s.has_value(), "basal.viscosity_pa_s",
         " (mixture is there too, whose fluid has a viscosity). Use mixture.fluid_viscosity_pa_s.");
  refuse(s.basal.yield_stress_pa.has_value(), "basal.yield_stress_pa",
         " (mixture is there too, which is held by its grains). Remove it.");
  refuse(s.grains && asks_for_internal_friction(s.grains->earth_pressure), "grains.earth_pressure",
         " (mixture is there too, in which water carries part of the load; it knows isotropic "
         "only). Remove it.");
  for (const BasalZone& zone : s.basal.zones)
    if (zone.pore_pressure_ratio) {
      problems.push_back({"basal.zones",
                          "basal.zones: pore_pressure_ratio of a zone (mixture is "
                          "there too, which computes the pore pressure). Remove "
                          "it."});
      break;
    }
  refuse(wet.initial_pressure == InitialPressure::liquefied && wet.initial_pressure_ratio,
         "mixture.initial_pressure_ratio",
         " (mixture.initial_pressure is liquefied, which is a ratio of 1). Keep one of them.");
  const bool parabola = wet.pressure_profile == PressureProfile::parabola;
  const char* const unresolved =
      " (mixture.pressure_profile is parabola, which has no nodes and drains at the surface). Set "
      "mixture.pressure_profile: resolved or remove it.";
  refuse(parabola && wet.pressure_nodes, "mixture.pressure_nodes", unresolved);
  refuse(parabola && wet.drainage == Drainage::both, "mixture.drainage", unresolved);
  if (!s.grains) return;
  const double heaviest = support(wet.fluid_density_kg_m3).second;
  const double lightest = support(s.grains->density_kg_m3).first;
  if (heaviest >= lightest)
    problems.push_back({"mixture.fluid_density_kg_m3",
                        "mixture.fluid_density_kg_m3 = " + number_text(heaviest) +
                            " (must be below grains.density_kg_m3 = " + number_text(lightest) +
                            ": grains that float have no effective stress)."});
}

/// Two velocities have no pore pressure of their own, and columns that do not mix with a bed.
void check_phases(const Scenario& s, Problems& problems) {
  if (!s.mixture) return;
  const MixtureSpec& wet = *s.mixture;
  const auto refuse = [&](bool given, const char* path, const char* why) {
    if (given) problems.push_back({path, shown(s, path) + why});
  };
  if (!has_two_phases(s.mixture)) {
    const char* const why =
        " (mixture.phases is one: grains and water move together). Remove it "
        "or set mixture.phases: two.";
    refuse(wet.drag_law != PhaseDragLaw::permeability, "mixture.drag_law", why);
    refuse(wet.settling_speed_m_s.has_value(), "mixture.settling_speed_m_s", why);
    return;
  }
  const char* const no_pressure =
      " (mixture.phases is two: the liquid carries the grains' buoyancy and no excess pressure). "
      "Remove it or set mixture.phases: one.";
  refuse(wet.initial_pressure != InitialPressure::hydrostatic, "mixture.initial_pressure",
         no_pressure);
  refuse(wet.initial_pressure_ratio.has_value(), "mixture.initial_pressure_ratio", no_pressure);
  refuse(wet.pressure_profile != PressureProfile::parabola, "mixture.pressure_profile",
         no_pressure);
  refuse(wet.settling_speed_m_s && wet.drag_law != PhaseDragLaw::settling,
         "mixture.settling_speed_m_s",
         " (mixture.drag_law is permeability). Remove it or set mixture.drag_law: settling.");
  const auto not_yet = [&](bool given, const std::string& path) {
    if (given)
      problems.push_back({path, path + " (mixture.phases is two: what joins or brakes two sets of "
                                       "columns this way is not computed). Remove it or set "
                                       "mixture.phases: one."});
  };
  not_yet(s.erosion.has_value(), "erosion");
  not_yet(!s.inflow.empty(), "inflow");
  not_yet(s.release.start_time_s.has_value(), "release.start_time_s");
  not_yet(!s.release.start_time_attribute.empty(), "release.start_time_attribute");
  not_yet(names_any_raster(s.basal), "basal.rasters");
}

void check_drag(const Scenario& s, Problems& problems) {
  const char* const path = "basal.yield_stress_pa";
  if (s.basal.yield_stress_pa && !s.basal.viscosity_pa_s)
    problems.push_back({path, shown(s, path) +
                                  " (basal.viscosity_pa_s is missing). Add it: a Bingham fluid has "
                                  "both."});
}

}  // namespace

void check_material(const Scenario& s, Problems& problems) {
  check_grains(s, problems);
  check_states(s, problems);
  check_pores_inside(s, problems);
  check_formulation(s, problems);
  check_mixture(s, problems);
  check_phases(s, problems);
  check_drag(s, problems);
}

}  // namespace sturz
