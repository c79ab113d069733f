// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/effect_table.hpp"

#include "engine/core/constants.hpp"
#include "engine/effects/bed/effect.hpp"
#include "engine/effects/columns/effect.hpp"
#include "engine/effects/columns/mixture.hpp"
#include "engine/effects/coupling/effect.hpp"
#include "engine/effects/dense/effect.hpp"
#include "engine/effects/dilatancy/effect.hpp"
#include "engine/effects/discrete/effect.hpp"
#include "engine/effects/erosion/effect.hpp"
#include "engine/effects/inflow/effect.hpp"
#include "engine/effects/isolated/contacts.hpp"
#include "engine/effects/isolated/effect.hpp"
#include "engine/effects/kinetic/effect.hpp"
#include "engine/effects/liquid/effect.hpp"
#include "engine/effects/motion/effect.hpp"
#include "engine/effects/motion/gravity.hpp"
#include "scenarios/assembly/discrete/discrete_plan.hpp"
#include "scenarios/assembly/erosion/erosion_plan.hpp"
#include "scenarios/assembly/grains/strength_inside.hpp"
#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/assembly/phases/phase_plan.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/schema/raster_fields.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace sturz {
namespace {

bool columns(const ScenePlan& plan) { return plan.formulation.depth_averaged; }

Called always(const Scenario&, const ScenePlan&) { return {true, "always"}; }

/// A key or block whose presence is the switch.
Called by_key(const char* key, bool given) {
  return {given, (given ? "`" : "no `") + std::string(key) + "`"};
}

/// The same for what only grains in full stress can have.
Called by_grain_key(const ScenePlan& plan, const char* key, bool given) {
  if (given && columns(plan)) return {false, "not in depth_averaged"};
  return by_key(key, given);
}

const GrainStatesSpec* states_of(const Scenario& s) {
  return s.grains && s.grains->states ? &*s.grains->states : nullptr;
}

Called bed_called(const Scenario& s, const ScenePlan& plan) {
  if (plan.liquid) {
    const std::string liquid = liquid_bed_text(s, plan.formulation);
    return {true, s.grains
                      ? "always: friction_coefficient, cohesion_pa of `basal` for the grains, " +
                            liquid + " for the liquid"
                      : "always: " + liquid};
  }
  if (has_two_phases(s.mixture))
    return {true,
            "always: friction_coefficient on what buoyancy leaves and cohesion_pa of `basal` for "
            "the grains, fluid_viscosity_pa_s for the liquid"};
  if (s.mixture)
    return {true,
            "always: friction_coefficient on what pore pressure leaves, cohesion_pa of `basal`"};
  return {true, "always: friction_coefficient, pore_pressure_ratio, cohesion_pa of `basal`"};
}
Called walls_called(const Scenario& s, const ScenePlan&) {
  return by_key("domain.walls", !s.domain.walls.empty());
}
Called grain_stress_called(const Scenario& s, const ScenePlan& plan) {
  if (columns(plan)) return {false, "not in depth_averaged"};
  if (plan.discrete) return {false, "not in discrete"};
  if (!s.grains) return by_key("grains", false);
  return {true, "`grains`: elastic + mu(I), 3-D, full stress; " + strength_text(s)};
}
Called liquid_called(const Scenario& s, const ScenePlan& plan) {
  if (!plan.liquid) return by_key("fluid", false);
  return {true, liquid_text(s, plan)};
}
Called coupling_called(const Scenario& s, const ScenePlan& plan) {
  if (!plan.coupling) return {false, s.fluid ? "no `grains`" : "no `fluid`"};
  return {true, coupling_text(s, plan)};
}
Called dilatancy_called(const Scenario& s, const ScenePlan& plan) {
  if (!plan.dilatancy) return by_key("coupling.critical_solid_fraction", false);
  return {true, dilatancy_text(s)};
}
Called grain_contacts_called(const Scenario& s, const ScenePlan& plan) {
  if (!plan.discrete) return by_key("formulation: discrete", false);
  return {true, discrete_text(s, plan)};
}
Called kinetic_theory_called(const Scenario& s, const ScenePlan& plan) {
  const auto* states = states_of(s);
  return by_grain_key(plan, "grains.states.dilute", states && states->dilute);
}
Called states_called(const Scenario& s, const ScenePlan& plan) {
  return by_grain_key(plan, "grains.states", states_of(s) != nullptr);
}
Called isolated_called(const Scenario& s, const ScenePlan& plan) {
  const auto* states = states_of(s);
  return by_grain_key(plan, "grains.states.ultradilute", states && states->ultradilute);
}
Called contacts_called(const Scenario&, const ScenePlan& plan) {
  return by_grain_key(plan, "grains.states.ultradilute.contacts: hertz_mindlin",
                      plan.isolated_contacts.has_value());
}
Called column_pressure_called(const Scenario& s, const ScenePlan& plan) {
  if (!columns(plan)) return {false, "not in " + plan.formulation.name()};
  if (plan.phases) return {true, "`mixture.phases: two`: of grains and liquid on both, K = 1"};
  if (s.mixture) return {true, "`mixture`: isotropic, K = 1, piles too"};
  const std::string key =
      "`grains.earth_pressure: " + std::string(to_string(s.grains->earth_pressure)) + "`";
  if (plan.columns.spent_inside.empty())
    return {true, knows_internal_friction(plan.columns) ? key : key + ", K = 1"};
  const double most =
      *std::max_element(plan.columns.spent_inside.begin(), plan.columns.spent_inside.end());
  return {true, key + ": the release is " +
                    short_number(plan.release.median_thickness_m / plan.release_narrow_side_m) +
                    " times as thick as it is wide; internal friction takes up to " +
                    short_number(100 * most) + " % of the thrust that drives"};
}
Called phases_called(const Scenario& s, const ScenePlan& plan) {
  if (!plan.phases) return by_key("mixture.phases: two", false);
  return {true, drag_text(s, *plan.phases, plan.release.median_thickness_m)};
}
Called mixture_called(const Scenario& s, const ScenePlan& plan) {
  if (plan.phases) return {false, "`mixture.phases: two` has buoyancy in its place"};
  if (!s.mixture) return by_key("mixture", false);
  const double m = s.grains->solid_fraction.value,
               critical = s.mixture->critical_solid_fraction.value;
  const std::string than =
      " than critical (" + short_number(m) + ", " + short_number(critical) + ")";
  const ProfileSettings& profile = plan.columns.mixture->profile;
  const std::string inside =
      profile.nodes == 0 ? ""
                         : "; excess pressure at " + std::to_string(profile.nodes) + " nodes, " +
                               (profile.drained_bed
                                    ? "drained at surface and bed: the bed brakes as in still water"
                                    : "drained at the surface");
  return {true,
          (m < critical ? "`mixture`: looser" + than + ", shear makes pore pressure"
                        : "`mixture`: not looser" + than + ", shear takes pore pressure away") +
              inside};
}
Called erosion_called(const Scenario& s, const ScenePlan&) {
  if (!s.erosion) return by_key("erosion", false);
  return {true, erosion_text(*s.erosion)};
}
Called inflow_called(const Scenario& s, const ScenePlan& plan) {
  if (plan.inflow.empty()) return by_key("inflow", false);
  return {true, inflow_text(s, plan.inflow)};
}
Called later_called(const Scenario& s, const ScenePlan& plan) {
  if (plan.later.empty()) return by_key("release.start_time_s", false);
  return {true, later_text(plan.later, s, plan.bulk_density_kg_m3)};
}
Called turbulence_called(const Scenario& s, const ScenePlan&) {
  if (const auto zone = zone_with_turbulence(s.basal); zone && !s.basal.turbulent_coefficient_m_s2)
    return {true, "`basal.zones[" + std::to_string(*zone) + "].turbulent_coefficient_m_s2`"};
  if (!s.basal.turbulent_coefficient_m_s2 &&
      !s.basal.rasters.turbulent_coefficient_m_s2.path.empty())
    return {true, "`basal.rasters.turbulent_coefficient_m_s2`"};
  return by_key("basal.turbulent_coefficient_m_s2", s.basal.turbulent_coefficient_m_s2.has_value());
}
Called viscosity_called(const Scenario& s, const ScenePlan&) {
  return by_key("basal.viscosity_pa_s", s.basal.viscosity_pa_s.has_value());
}
Called zones_called(const Scenario& s, const ScenePlan&) {
  return by_key("basal.zones", !s.basal.zones.empty());
}
Called rasters_called(const Scenario& s, const ScenePlan&) {
  for (const RasterField& field : raster_fields)
    if (names_raster(s.basal, field)) return by_key(raster_path(field).c_str(), true);
  return by_key("basal.rasters", false);
}
Called samosat_called(const Scenario& s, const ScenePlan&) {
  return by_key("basal.samosat", s.basal.samosat.has_value());
}
Called periods_called(const Scenario& s, const ScenePlan&) {
  return by_key("domain.periodic", !s.domain.periodic.empty());
}
Called structures_called(const Scenario& s, const ScenePlan&) {
  if (s.terrain.dams.empty() && s.terrain.buildings) return by_key("terrain.buildings", true);
  return by_key("terrain.dams", !s.terrain.dams.empty());
}
Called excavation_called(const Scenario& s, const ScenePlan&) {
  return {s.release.surface == ReleaseSurface::pre_failure,
          "`release.surface: " + std::string(to_string(s.release.surface)) + "`"};
}

constexpr std::size_t grains = 0;  // index of the set

// Columns bring gravity, bed, walls and motion in passes of their own.
void add_kick(SceneParts& p) {
  for (std::size_t set = 0; set < p.state.sets.size() && !columns(p.plan); ++set)
    add_gravity(p.step, p.state, set);
}
// Grains touch ground and walls as they touch each other, in one pass.
void add_bed(SceneParts& p) {
  if (p.plan.discrete)
    add_ground_lookup(p.step, grains, p.plan.contact);
  else if (!columns(p.plan) && p.scenario.grains)
    add_terrain_contact(p.step, grains, p.plan.contact);
}
void add_walls(SceneParts& p) {
  if (!columns(p.plan) && !p.plan.discrete && p.scenario.grains)
    add_wall_contact(p.step, grains, p.plan.contact);
}
void add_grains(SceneParts& p) { add_discrete_grains(p.step, p.state, grains, *p.plan.discrete); }
void add_drift(SceneParts& p) {
  if (p.plan.discrete) {
    const double d = p.plan.discrete->diameter;
    return add_motion(p.step, grains, {d, d});
  }
  const double dx = p.scenario.numerics.spacing_m;
  for (std::size_t set = 0; set < p.state.sets.size() && !columns(p.plan); ++set)
    add_motion(p.step, set, {dx, smoothing_ratio * dx});
}
void add_stress(SceneParts& p) {
  const std::vector<double>& depth = p.plan.release.depth;
  p.grain_stress = add_grain_stress(p.step, p.state, grains, p.plan.stress,
                                    p.plan.coupling ? p.plan.liquid_start.grain_depth : depth);
}
void add_loosening(SceneParts& p) {
  add_dilatancy(p.step, p.state, p.grain_stress, *p.plan.dilatancy);
}
void add_couplings(SceneParts& p) {
  add_coupling(p.step, p.state, grains, liquid_set(p.scenario), *p.plan.coupling);
}
void add_collisions(SceneParts& p) { add_kinetic_theory(p.step, p.state, p.grain_stress); }
void add_states(SceneParts& p) { add_grain_states(p.step, p.state, p.grain_stress); }
void add_isolated(SceneParts& p) { add_isolated_particles(p.step, p.state, p.grain_stress); }
void add_contacts(SceneParts& p) {
  add_isolated_contacts(p.step, p.state, grains, *p.plan.isolated_contacts);
}
void add_pores(SceneParts& p) { add_mixture(p.state, grains, *p.plan.columns.mixture); }
void add_columns(SceneParts& p) {
  const Release& r = p.plan.release;
  if (p.plan.phases) {
    const double m = p.scenario.grains->solid_fraction.value;
    add_two_phases(p.step, p.state, *p.plan.phases, thickness_of(r, m), thickness_of(r, 1 - m),
                   r.covered, r.covered);
    return;
  }
  add_depth_averaged(p.step, p.state, grains, p.plan.columns,
                     std::span(r.thickness).first(p.plan.n_present),
                     std::span(r.covered).first(p.plan.n_present));
}
/// Releases start as the run does: after short steps.
double start_step(const SceneParts& p) {
  return std::max(0.05 * std::sqrt(p.plan.bed.grid().cell_m / standard_gravity), 1e-5);
}
void add_sources(SceneParts& p) {
  add_inflow(p.step, p.state, grains, {p.plan.inflow.columns, start_step(p)});
}
void add_later(SceneParts& p) {
  add_inflow(p.step, p.state, grains, {p.plan.later, start_step(p)});
}
void add_eroded_bed(SceneParts& p) { add_erosion(p.step, p.state, grains, *p.plan.erosion); }

constexpr EffectRow table[] = {
    {EffectName::gravity, always, add_kick},
    {EffectName::grain_stress, grain_stress_called, add_stress, grain_stress_bytes_per_particle},
    {EffectName::dilatancy, dilatancy_called, add_loosening},
    // Sorted grains before the lists across, the liquid's ground before the drag, which takes what
    // it gave, and the grains' friction after both.
    {EffectName::liquid, liquid_called, add_liquid_parts, liquid_bytes_per_particle},
    {EffectName::coupling, coupling_called, add_couplings, coupling_bytes_per_particle, true},
    {EffectName::bed, bed_called, add_bed},
    {EffectName::walls, walls_called, add_walls},
    {EffectName::grain_contacts, grain_contacts_called, add_grains, discrete_bytes_per_particle},
    {EffectName::kinetic_theory, kinetic_theory_called, add_collisions},
    {EffectName::states, states_called, add_states},
    {EffectName::isolated, isolated_called, add_isolated},
    {EffectName::isolated_contacts, contacts_called, add_contacts},
    {EffectName::pore_pressure, mixture_called, add_pores},
    {EffectName::column_pressure, column_pressure_called, add_columns, column_bytes_per_particle},
    {EffectName::phase_drag, phases_called},
    {EffectName::erosion, erosion_called, add_eroded_bed, erosion_bytes_per_particle},
    {EffectName::inflow, inflow_called, add_sources},
    {EffectName::later_release, later_called, add_later},
    {"turbulent bed", turbulence_called},
    {"viscous bed", viscosity_called},
    {"samosat bed", samosat_called},
    {"zones of the bed", zones_called},
    {"rasters of the bed", rasters_called},
    {"periodic images", periods_called},
    {EffectName::motion, always, add_drift},
    {"excavation", excavation_called},
    {"dams and buildings", structures_called},
};

}  // namespace

std::span<const EffectRow> effect_table() { return table; }

void add_effect(const EffectRow& row, SceneParts& parts) {
  parts.step.begin_effect(row.name);
  row.add(parts);
}

void add_effects(SceneParts& parts) {
  for (const EffectRow& row : table)
    if (row.add && row.called(parts.scenario, parts.plan).active) add_effect(row, parts);
}

}  // namespace sturz
