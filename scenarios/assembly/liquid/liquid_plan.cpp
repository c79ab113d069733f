// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/liquid/liquid_plan.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/sum.hpp"
#include "engine/effects/arrivals.hpp"
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

double filled_height(const Scenario& s) { return s.fluid->pool ? 1 : s.fluid->saturation.value; }

double weight_on_contacts(const Scenario& s) {
  if (!s.fluid || !has_buoyancy(s)) return 1;
  return 1 - filled_height(s) * s.fluid->density_kg_m3.value / s.grains->density_kg_m3.value;
}

double weight_on_grains(const Scenario& s) {
  const double alpha = s.grains->solid_fraction.value;
  const double grains = s.grains->density_kg_m3.value * alpha;
  const double liquid = filled_height(s) * s.fluid->density_kg_m3.value * (1 - alpha);
  return weight_on_contacts(s) * grains / (grains + liquid);
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
  const double deepest = std::max(plan.release.max_thickness_m, plan.liquid_start.deepest_m);
  const double at_rest = std::sqrt(standard_gravity * deepest);
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
  c.shear_stiffness = LiquidSettings{}.shear_stiffness;
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
  const double deepest = std::max(c.spacing, plan.liquid_start.deepest_m);
  c.stiffness = std::max(c.stiffness, 10 * standard_gravity * deepest / (c.spacing * c.spacing));
  c.bed = {GroundFriction{0, 0, 0}};
  c.zones = {};
  c.rasters = {};
  c.liquid = LiquidContact{liquid_law(*s.fluid), as_engine(liquid_bed(s, plan.formulation))};
  for (const WallSpec& wall : s.domain.walls)
    c.liquid->wall_holds.push_back(wall.liquid == WallLiquid::sticks);
  return c;
}

void lay_liquid(State& state, const Scenario& s, const ScenePlan& plan) {
  const LiquidLattice& at = plan.liquid_start;
  if (s.grains) {
    MovingSet& grains = state.sets.front();
    const double fraction = s.grains->solid_fraction.value;
    const double solid = fraction * s.grains->density_kg_m3.value;
    for (std::size_t i = 0; i < grains.size(); ++i)
      grains.mass[i] = solid * (plan.release.mass[i] / plan.bulk_density_kg_m3);
    grains.bulk_density = solid;
    grains.filled_share = fraction;
    grains.ledger.released_mass = released_mass(grains);
  }
  const double spacing = state.sets.front().spacing;
  if (s.grains)
    state.sets.emplace_back();
  else
    state.sets.front() = MovingSet();
  MovingSet& liquid = state.sets[liquid_set(s)];
  liquid.spacing = spacing;
  liquid.grow(at.size());
  liquid.x = at.x, liquid.y = at.y, liquid.z = at.z, liquid.mass = at.mass;
  const auto& v = s.release.velocity_m_s;
  const auto moving = static_cast<std::ptrdiff_t>(at.n_in_release);
  std::fill_n(liquid.vx.begin(), moving, v[0]);
  std::fill_n(liquid.vy.begin(), moving, v[1]);
  std::fill_n(liquid.vz.begin(), moving, v[2]);
  mark_start(state.domain, liquid, 0);
  liquid.name = "liquid";
  liquid.bulk_density = s.fluid->density_kg_m3.value;
  liquid.reference_fraction = 0;
  liquid.ledger.released_mass = released_mass(liquid);
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
  add_liquid(p.step, p.state, set, *p.plan.liquid, p.plan.liquid_start.depth);
}

}  // namespace sturz
