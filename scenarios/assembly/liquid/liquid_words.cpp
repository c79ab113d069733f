// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/drag.hpp"
#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/schema/number_text.hpp"

#include <cmath>

namespace sturz {
namespace {

std::string law_text(const FluidSpec& fluid) {
  const HerschelBulkley law = liquid_law(fluid);
  const std::string viscosity =
      law.index == 1 ? "viscosity " + short_number(law.consistency) + " Pa s"
                     : "K " + short_number(law.consistency) + ", n " + short_number(law.index);
  if (law.newtonian()) return "Newton's law, " + viscosity;
  return (law.index == 1 ? "Bingham's law, " : "Herschel and Bulkley's law, ") + viscosity +
         ", yield stress " + short_number(law.yield_stress) + " Pa";
}

std::string pool_text(const Scenario& s, const ScenePlan& plan) {
  if (!s.fluid->pool) return "";
  const LiquidLattice& start = plan.liquid_start;
  return "; `fluid.pool`: standing water up to " + short_number(s.fluid->pool->surface_m->value) +
         " m, " + short_number(start.pool_m3) + " m3 on " + short_number(start.pool_area_m2) +
         " m2 with what lies in it, " + short_number(start.pool_depth_m) + " m or " +
         short_number(start.pool_depth_m / s.numerics.spacing_m) + " layers deep, " +
         std::to_string(start.size() - start.n_in_release) +
         " particles beside those in the release";
}

/// Within which a slow slip falls to 1/e [s].
double slip_time(const Scenario& s, const CouplingSettings& c) {
  const GranularDrag law{c.drag_diameter, c.liquid_density, c.viscosity};
  const double alpha = s.grains->solid_fraction.value;
  return 1 / (c.drag_multiplier * law.exchange(alpha, 0) *
              (1 / (alpha * c.grain_density) + 1 / (liquid_share(s) * c.liquid_density)));
}

/// The largest pore_pressure_ratio of the bed and its zones.
double largest_pore_pressure_ratio(const BasalSpec& basal) {
  double most = basal.pore_pressure_ratio.value;
  for (const BasalZone& zone : basal.zones)
    if (zone.pore_pressure_ratio) most = std::fmax(most, zone.pore_pressure_ratio->value);
  return most;
}

bool has_pore_pressure_ratio(const BasalSpec& basal) {
  return largest_pore_pressure_ratio(basal) > 0 || !basal.rasters.pore_pressure_ratio.path.empty();
}

std::string pore_pressure_warning(const Scenario& s) {
  const double most = largest_pore_pressure_ratio(s.basal);
  const std::string key = most > s.basal.pore_pressure_ratio.value
                              ? "a pore_pressure_ratio of the bed of " + short_number(most)
                          : most > 0 ? "basal.pore_pressure_ratio = " + short_number(most)
                                     : "basal.rasters.pore_pressure_ratio";
  if (!has_buoyancy(s))
    return "pore pressure is counted twice: " + key +
           " lies beside a fluid that drives the grains (coupling.scheme: paper, as published). It "
           "is no prediction";
  return key +
         " lies beside a fluid that fills the pores: the fluid carries its share of the grains "
         "already, so that this counts as excess over its pressure. Use 0 where it was meant as "
         "the whole pore pressure";
}

}  // namespace

std::string liquid_text(const Scenario& s, const ScenePlan& plan) {
  std::string text = "`fluid`: " + law_text(*s.fluid) + "; " +
                     short_number(plan.formulation.release_layers) +
                     " layers at release; numerical sound speed " +
                     short_number(std::round(plan.liquid->sound_speed)) + " m/s";
  if (plan.liquid->least_sound_speed < plan.liquid->sound_speed)
    text += ", down to " + short_number(std::round(plan.liquid->least_sound_speed)) +
            " while it is slow";
  return text + pool_text(s, plan);
}

std::string liquid_bed_text(const Scenario& s, const FormulationChoice& formulation) {
  const std::string bed(to_string(liquid_bed(s, formulation)));
  if (s.fluid->bed != FluidBed::automatic) return "`fluid.bed: " + bed + "`";
  return "`fluid.bed: auto`: " + bed + ", " + short_number(formulation.layers) + " layers";
}

std::string coupling_text(const Scenario& s, const ScenePlan& plan) {
  const CouplingSettings& c = *plan.coupling;
  const double h = c.smoothing_length, d = s.grains->diameter_m.value;
  std::string text = s.coupling ? "`coupling`: " : "`grains` and `fluid`: ";
  text += c.buoyancy ? "drag and buoyancy" : "scheme: paper, drag without buoyancy";
  const double filled = s.fluid->saturation.value;
  text += filled < 1 ? "; fluid in the lowest " + short_number(100 * filled) + " % of the pores"
                     : "; fluid in 100 % of the pores";
  text += "; drag of grains of " + short_number(c.drag_diameter) + " m";
  if (s.coupling && s.coupling->drag_diameter_m)
    text += " (coupling.drag_diameter_m; grains.diameter_m is " + short_number(d) + ")";
  if (c.drag_multiplier != 1) text += " times " + short_number(c.drag_multiplier);
  text += ": a slow slip dies out within " + short_number(slip_time(s, c)) + " s";
  return text + "; smoothing length " + short_number(h / d) + " grain diameters";
}

std::string dilatancy_text(const Scenario& s) {
  const double released = s.grains->solid_fraction.value;
  const double critical = s.coupling->critical_solid_fraction->value;
  const std::string than =
      " than critical (" + short_number(released) + ", " + short_number(critical) + "), shear ";
  return "`coupling.critical_solid_fraction`: " +
         (released < critical
              ? "looser" + than + "tightens the grains and the liquid takes over their load"
              : "not looser" + than +
                    "loosens the grains, which draw in liquid and are braked by it");
}

std::vector<std::string> liquid_warnings(const Scenario& s, const ScenePlan& plan) {
  std::vector<std::string> out;
  if (s.fluid && plan.liquid_start.open_edge_m > s.numerics.spacing_m)
    out.push_back("open water: along " + short_number(plan.liquid_start.open_edge_m) +
                  " m of the outline of fluid.pool the ground beside it lies below its surface, "
                  "where it runs out from the start. Draw the outline beyond the shore, or put "
                  "domain.walls there");
  if (s.fluid && s.fluid->pool)
    out.push_back(
        std::string("standing water counts from the start: its cells are reached, its depth is "
                    "thickness, and run-out and areas go to its shores. ") +
        (plan.coupling ? "What the grains reach is told apart (solid_..., runout of each)"
                       : "Speed and energy tell what moves"));
  if (!plan.coupling) return out;
  const CouplingSettings& c = *plan.coupling;
  if (c.drag_multiplier != 1)
    out.push_back("the drag between grains and liquid is multiplied by " +
                  short_number(c.drag_multiplier) + " (coupling.drag_multiplier): 1 is physics");
  if (!c.buoyancy)
    out.emplace_back(
        "grains without buoyancy (coupling.scheme: paper): in a fluid they bear their whole weight "
        "on each other and on the bed");
  if (has_pore_pressure_ratio(s.basal)) out.push_back(pore_pressure_warning(s));
  if (liquid_law(*s.fluid).index != 1)
    out.push_back("the drag takes the fluid's viscosity at a shear rate of 1 1/s, " +
                  short_number(c.viscosity) + " Pa s (fluid.index)");
  return out;
}

}  // namespace sturz
