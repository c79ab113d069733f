// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/liquid/liquid_plan.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/sum.hpp"
#include "engine/effects/coupling/effect.hpp"
#include "engine/effects/liquid/effect.hpp"
#include "scenarios/assembly/effect_table.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/assembly/speed/expected_speed.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

CouplingSpec coupling_of(const Scenario& s) { return s.coupling.value_or(CouplingSpec{}); }

double released_mass(const MovingSet& p) {
  Sum sum;
  for (const double m : p.mass) sum.add(m);
  return sum.value();
}

LiquidBed as_engine(FluidBed bed) {
  return bed == FluidBed::no_slip ? LiquidBed::no_slip
         : bed == FluidBed::film  ? LiquidBed::film
                                  : LiquidBed::slip;
}

bool fills_pores(const Scenario& s) { return s.fluid->saturation.value >= 1; }

}  // namespace

bool is_liquid_alone(const Scenario& s) { return s.fluid && !s.grains; }

bool has_buoyancy(const Scenario& s) { return coupling_of(s).scheme == CouplingScheme::physical; }

std::size_t liquid_set(const Scenario& s) { return s.grains ? 1 : 0; }

double liquid_share(const Scenario& s) {
  if (!s.grains) return 1;
  return s.fluid->saturation.value * (1 - s.grains->solid_fraction.value);
}

double wet_bulk_density(const Scenario& s) {
  const double grains =
      s.grains ? s.grains->density_kg_m3.value * s.grains->solid_fraction.value : 0;
  return grains + s.fluid->density_kg_m3.value * liquid_share(s);
}

double weight_on_contacts(const Scenario& s) {
  if (!s.fluid || !has_buoyancy(s) || !fills_pores(s)) return 1;
  return 1 - s.fluid->density_kg_m3.value / s.grains->density_kg_m3.value;
}

double weight_on_grains(const Scenario& s) {
  const double grains = s.grains->density_kg_m3.value * s.grains->solid_fraction.value;
  return weight_on_contacts(s) * grains / wet_bulk_density(s);
}

double plain_viscosity(const FluidSpec& fluid) {
  return fluid.viscosity_pa_s.value_or(fluid.consistency_pa_sn.value_or(Uncertain(0.001))).value;
}

HerschelBulkley liquid_law(const FluidSpec& fluid) {
  HerschelBulkley law;
  law.consistency = plain_viscosity(fluid);
  if (fluid.yield_stress_pa) law.yield_stress = fluid.yield_stress_pa->value;
  if (fluid.consistency_pa_sn && fluid.index) law.index = fluid.index->value;
  return law;
}

LiquidSettings plan_liquid(const Scenario& s, const ScenePlan& plan) {
  LiquidSettings liquid;
  liquid.law = liquid_law(*s.fluid);
  liquid.spacing = s.numerics.spacing_m;
  liquid.smoothing_length = smoothing_ratio * s.numerics.spacing_m;
  liquid.reference_density = s.fluid->density_kg_m3.value;
  liquid.viscosity = s.fluid->artificial_viscosity;
  liquid.density_diffusion = s.numerics.density_diffusion;
  liquid.courant = s.numerics.courant;
  liquid.instruction_set = best_instruction_set();
  // As of grains: within about 1 % of its density in motion and at rest (docs/physics.md A.2).
  const double at_rest = std::sqrt(standard_gravity * plan.release.max_thickness_m);
  const double factor = s.numerics.sound_speed_factor;
  liquid.sound_speed = factor * std::max({plan.reference_speed_m_s, at_rest, start_speed(s)});
  liquid.least_sound_speed =
      s.numerics.adaptive_sound_speed ? factor * at_rest : liquid.sound_speed;
  liquid.speed_factor = factor;
  return liquid;
}

CouplingSettings plan_coupling(const Scenario& s) {
  const CouplingSpec spec = coupling_of(s);
  CouplingSettings c;
  c.grain_density = s.grains->density_kg_m3.value;
  c.liquid_density = s.fluid->density_kg_m3.value;
  c.viscosity = plain_viscosity(*s.fluid);
  c.drag_diameter = spec.drag_diameter_m.value_or(s.grains->diameter_m).value;
  c.drag_multiplier = spec.drag_multiplier.value;
  c.buoyancy = has_buoyancy(s);
  c.spacing = s.numerics.spacing_m;
  c.smoothing_length = smoothing_ratio * c.spacing;
  return c;
}

std::optional<DilatancySettings> plan_dilatancy(const Scenario& s) {
  const CouplingSpec spec = coupling_of(s);
  if (!s.fluid || !s.grains || !spec.critical_solid_fraction) return std::nullopt;
  DilatancySettings d;
  d.law.solid_density = s.grains->density_kg_m3.value;
  d.law.fluid_density = s.fluid->density_kg_m3.value;
  d.law.fluid_viscosity = plain_viscosity(*s.fluid);
  d.law.critical_fraction = spec.critical_solid_fraction->value;
  d.law.grain_diameter = spec.drag_diameter_m.value_or(s.grains->diameter_m).value;
  d.reference_fraction = s.grains->solid_fraction.value;
  d.slope = spec.dilatancy_slope.value;
  return d;
}

FluidBed liquid_bed(const Scenario& s, const FormulationChoice& formulation) {
  if (s.fluid->bed != FluidBed::automatic) return s.fluid->bed;
  return formulation.layers >= resolved_layers ? FluidBed::no_slip : FluidBed::film;
}

ContactSettings liquid_contact(const Scenario& s, const ScenePlan& plan) {
  ContactSettings c = plan.contact;
  c.reference_density = s.fluid->density_kg_m3.value;
  c.internal_friction = ContactSettings{}.internal_friction;
  c.bed = {GroundFriction{0, 0, 0}};
  c.zones = {};
  c.rasters = {};
  c.liquid = LiquidContact{liquid_law(*s.fluid), as_engine(liquid_bed(s, plan.formulation))};
  return c;
}

void lay_liquid(State& state, const Scenario& s, const ScenePlan& plan) {
  const double density = s.fluid->density_kg_m3.value;
  if (s.grains) {
    state.sets.push_back(state.sets.front());
    MovingSet &grains = state.sets[0], &liquid = state.sets[1];
    const double fraction = s.grains->solid_fraction.value;
    const double solid = fraction * s.grains->density_kg_m3.value;
    const double fluid = liquid_share(s) * density;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      const double volume = plan.release.mass[i] / plan.bulk_density_kg_m3;
      grains.mass[i] = solid * volume;
      liquid.mass[i] = fluid * volume;
    }
    grains.bulk_density = solid;
    grains.filled_share = fraction;
    grains.ledger.released_mass = released_mass(grains);
  }
  MovingSet& liquid = state.sets[liquid_set(s)];
  liquid.name = "liquid";
  liquid.bulk_density = density;
  liquid.reference_fraction = 0;
  liquid.ledger.released_mass = released_mass(liquid);
}

std::vector<double> depth_on_contacts(const Scenario& s, const std::vector<double>& depth) {
  std::vector<double> borne = depth;
  const double share = weight_on_contacts(s);
  for (double& h : borne) h *= share;
  return borne;
}

void add_liquid_parts(SceneParts& p) {
  const Scenario& s = p.scenario;
  const std::size_t set = liquid_set(s);
  if (p.plan.coupling) add_coupling_fields(p.state, set);
  p.step.begin_effect(EffectName::bed);
  add_terrain_contact(p.step, set, p.plan.liquid_contact);
  if (!s.domain.walls.empty()) {
    p.step.begin_effect(EffectName::walls);
    add_wall_contact(p.step, set, p.plan.liquid_contact);
  }
  p.step.begin_effect(EffectName::liquid);
  if (fills_pores(s)) return add_liquid(p.step, p.state, set, *p.plan.liquid, p.plan.release.depth);
  const std::size_t n = p.state.sets[set].size();
  const std::vector<double> no_surface(n, -1), saturation(n, s.fluid->saturation.value);
  add_liquid(p.step, p.state, set, *p.plan.liquid, no_surface, saturation);
}

}  // namespace sturz
