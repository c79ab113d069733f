// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/scene_plan.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/laws/grain_states.hpp"
#include "scenarios/assembly/bed/bed_rasters_plan.hpp"
#include "scenarios/assembly/bed/excavation.hpp"
#include "scenarios/assembly/discrete/discrete_plan.hpp"
#include "scenarios/assembly/erosion/erosion_plan.hpp"
#include "scenarios/assembly/grains/strength_inside.hpp"
#include "scenarios/assembly/ground.hpp"
#include "scenarios/assembly/inflow/plan_masses.hpp"
#include "scenarios/assembly/liquid/liquid_lattice.hpp"
#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/assembly/phases/phase_plan.hpp"
#include "scenarios/assembly/release_pattern.hpp"
#include "scenarios/assembly/speed/expected_speed.hpp"
#include "scenarios/assembly/start_checks.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Makes a terrain say that it needs more, where it does not hold the whole raster: a decision was
/// taken on another copy of the same ground. Of two opposite corners one is missing then.
void ask_for_more(const Terrain& ground) {
  ground.node(0, 0);
  ground.node(ground.grid().n_rows - 1, ground.grid().n_cols - 1);
}

/// A direction repeats over the terrain's extent; the ground may rise by a constant per period.
Period period_of(const Raster<double>& z, bool along_x) {
  const Grid& g = z.grid;
  Period p;
  p.active = true;
  p.min = along_x ? g.west_m : g.south_m();
  p.max = along_x ? g.east_m() : g.north_m;
  const int n = along_x ? g.n_cols : g.n_rows;
  const double first = along_x ? z.at(0, 0) : z.at(g.n_rows - 1, 0);
  const double last = along_x ? z.at(0, g.n_cols - 1) : z.at(0, 0);
  p.rise = (last - first) * n / (n - 1);
  return p;
}

/// A particle may meet the images of the others once, never its own or the same one twice.
void require_room(const Period& p, const char* direction, double spacing) {
  require(!p.active || p.length() >= 3 * spacing,
          std::string("domain.periodic = ") + direction + " (the terrain repeats after " +
              short_number(p.length()) + " m, less than three spacings of " +
              short_number(spacing) +
              " m). Use a longer terrain, or a finer numerics.spacing_m (in formulation: discrete "
              "smaller grains).");
}

Domain make_domain(const DomainSpec& spec, const Raster<double>& elevation) {
  Domain d;
  for (const std::string& direction : spec.periodic)
    (direction == "x" ? d.x : d.y) = period_of(elevation, direction == "x");
  for (const WallSpec& w : spec.walls) {
    Wall wall;
    wall.point = Vec3(w.point_m[0], w.point_m[1], w.point_m[2]);
    wall.normal = Vec3(w.normal[0], w.normal[1], w.normal[2]).normalized();
    wall.friction_coefficient = w.friction_coefficient;
    if (w.remove_at_s) wall.remove_at_s = *w.remove_at_s;
    d.walls.push_back(wall);
  }
  return d;
}

/// The bed of each zone; what a zone does not give is that of the whole bed.
std::vector<BasalResistance> basal_by_zone(const BasalSpec& spec) {
  BasalResistance all;
  all.friction_coefficient = spec.friction_coefficient.value;
  all.pore_pressure_ratio = spec.pore_pressure_ratio.value;
  all.cohesion_pa = spec.cohesion_pa.value;
  if (spec.turbulent_coefficient_m_s2)
    all.turbulent_coefficient = spec.turbulent_coefficient_m_s2->value;
  if (spec.viscosity_pa_s) all.viscosity_pa_s = spec.viscosity_pa_s->value;
  if (spec.yield_stress_pa) all.yield_stress_pa = spec.yield_stress_pa->value;
  if (spec.samosat) {
    all.samosat = true;
    all.fluidization_number = spec.samosat->fluidization_number.value;
    all.von_karman = spec.samosat->von_karman.value;
    all.roughness_m = spec.samosat->roughness_m.value;
    all.profile_offset = spec.samosat->profile_offset.value;
  }
  std::vector<BasalResistance> bed{all};
  for (const BasalZone& zone : spec.zones) {
    BasalResistance& b = bed.emplace_back(all);
    b.friction_coefficient = zone.friction_coefficient.value_or(b.friction_coefficient).value;
    b.pore_pressure_ratio = zone.pore_pressure_ratio.value_or(b.pore_pressure_ratio).value;
    b.cohesion_pa = zone.cohesion_pa.value_or(b.cohesion_pa).value;
    b.turbulent_coefficient =
        zone.turbulent_coefficient_m_s2.value_or(b.turbulent_coefficient).value;
  }
  return bed;
}

MixtureSettings plan_mixture(const GrainsSpec& grains, const MixtureSpec& spec) {
  MixtureSettings wet;
  wet.law.solid_density = grains.density_kg_m3.value;
  wet.law.fluid_density = spec.fluid_density_kg_m3.value;
  wet.law.fluid_viscosity = spec.fluid_viscosity_pa_s.value;
  wet.law.critical_fraction = spec.critical_solid_fraction.value;
  wet.law.grain_diameter = spec.shear_grain_diameter_m.value;
  wet.law.permeability = spec.permeability_m2.value;
  wet.law.reference_fraction = spec.permeability_fraction.value;
  wet.law.compressibility = spec.compressibility.value;
  wet.law.stress_offset = spec.stress_offset_pa.value;
  wet.solid_fraction = grains.solid_fraction.value;
  constexpr int usual_nodes = 8;
  if (spec.pressure_profile == PressureProfile::resolved)
    wet.profile = {spec.pressure_nodes.value_or(usual_nodes), spec.drainage == Drainage::both};
  if (spec.initial_pressure == InitialPressure::liquefied) wet.pressure_ratio = 1;
  if (spec.initial_pressure_ratio) wet.pressure_ratio = spec.initial_pressure_ratio->value;
  return wet;
}

/// Of the grains, and of what is between them where there is a mixture or a fluid.
double bulk_density(const Scenario& s, double solid_fraction) {
  if (s.fluid) return wet_bulk_density(s);
  return s.mixture ? plan_mixture(*s.grains, *s.mixture).law.density(solid_fraction)
                   : s.grains->density_kg_m3.value * solid_fraction;
}

void plan_columns(const Scenario& s, std::vector<BasalResistance> bed, ScenePlan& plan) {
  DepthAveragedSettings& c = plan.columns;
  c.spacing = s.numerics.spacing_m;
  c.density = plan.bulk_density_kg_m3;
  c.courant = s.numerics.courant;
  c.zones = plan.zones;
  c.rasters = plan.rasters;
  if (s.mixture && !has_two_phases(s.mixture)) c.mixture = plan_mixture(*s.grains, *s.mixture);
  c.instruction_set = best_instruction_set();
  c.earth_pressure.assign(bed.size(), EarthPressure{});
  const bool known = s.grains->friction || s.grains->friction_angle_deg;
  c.internal_friction = known ? friction_law(*s.grains).static_friction : 0;
  c.active_passive = s.grains->earth_pressure == LateralPressure::active_passive;
  if (c.active_passive)
    for (std::size_t k = 0; k < bed.size(); ++k)
      c.earth_pressure[k] = c.earth_pressure_over(bed[k]);
  // Water carries part of a mixture's load: pressure is isotropic in it (Iverson & George 2014).
  const bool by_shape = s.grains->earth_pressure == LateralPressure::automatic && known;
  const double share = s.mixture                                             ? 0
                       : s.grains->earth_pressure == LateralPressure::active ? 1
                       : by_shape                                            ? pile_share(s, plan)
                                                                             : 0;
  c.spent_share = share;
  if (share > 0)
    for (const BasalResistance& b : bed)
      c.spent_inside.push_back(share * std::max(0.0, 1 - c.earth_pressure_over(b).active));
  if (has_two_phases(s.mixture)) plan.phases = plan_phases(s, c, bed);
  c.bed = std::move(bed);
}

/// Grains that may part: reference packing and laws (docs/physics.md A.4, A.7, B.9).
GrainStatesSettings plan_states(const Scenario& s, double reference_fraction) {
  const GrainStatesSpec& spec = *s.grains->states;
  GrainStatesSettings states;
  states.reference_fraction = reference_fraction;
  if (s.fluid && s.grains->solid_fraction.value < reference_fraction)
    states.loose_fraction = s.grains->solid_fraction.value;
  states.friction.scale_pa = spec.frictional_pressure_pa.value;
  states.friction.max_fraction = spec.max_fraction
                                     ? spec.max_fraction->value
                                     : std::max(0.64, s.grains->solid_fraction.value + 0.08);
  if (spec.dilute)
    states.dilute = KineticTheory{s.grains->density_kg_m3.value, s.grains->diameter_m.value,
                                  spec.dilute->restitution.value, states.friction.max_fraction};
  states.ultradilute = spec.ultradilute.has_value();
  states.paper_switch = spec.stress_mode == StressMode::paper_switch;
  return states;
}

IsolatedContactSettings plan_isolated_contacts(const Scenario& s, double speed) {
  const UltradiluteSpec& spec = *s.grains->states->ultradilute;
  IsolatedContactSettings contacts;
  contacts.material.youngs_modulus = spec.youngs_modulus_pa;
  contacts.material.poisson_ratio = s.grains->poisson_ratio.value;
  contacts.material.density = s.grains->density_kg_m3.value;
  contacts.restitution = spec.restitution.value;
  contacts.friction = spec.friction_coefficient.value;
  contacts.speed_bound = speed;
  return contacts;
}

/// Of the grains alone as they are set down, what else is between them left out.
double grains_bulk_density(const Scenario& s, const ScenePlan& plan) {
  return s.fluid && s.grains ? s.grains->density_kg_m3.value * plan.reference_fraction
                             : plan.bulk_density_kg_m3;
}

void plan_grain_stress(const Scenario& s, ScenePlan& plan) {
  const double dx = s.numerics.spacing_m, h = smoothing_ratio * dx;
  const double start = start_speed(s), deepest = plan.release.max_thickness_m;
  GrainStressSettings& stress = plan.stress;
  stress.law = law_inside(s);
  stress.friction_cone = s.grains->friction_cone;
  stress.spacing = dx;
  stress.smoothing_length = h;
  stress.reference_density = grains_bulk_density(s, plan);
  stress.poisson_ratio = s.grains->poisson_ratio.value;
  stress.viscosity = s.numerics.artificial_viscosity;
  stress.density_diffusion = s.numerics.density_diffusion;
  stress.courant = s.numerics.courant;
  stress.instruction_set = best_instruction_set();
  // c0 >= 10 v_ref keeps the density within about 1 % in motion, and K = rho c0^2/(1 + 4G/3K)
  // >= 100 rho g H does so at rest (docs/physics.md B.5).
  const double at_rest =
      std::sqrt((1 + 4.0 / 3 * stress.shear_to_bulk()) * standard_gravity * deepest);
  stress.sound_speed =
      s.numerics.sound_speed_factor * std::max({plan.reference_speed_m_s, at_rest, start});
  stress.speed_factor = s.numerics.sound_speed_factor;
  if (s.numerics.adaptive_sound_speed)
    stress.least_sound_speed = s.numerics.sound_speed_factor * at_rest;
  if (s.grains->states) {
    stress.states = plan_states(s, plan.reference_fraction);
    // Loose packings are never stiffer than the grains' own elasticity at its softest.
    GrainStressSettings softest = stress;
    softest.sound_speed = std::min(stress.sound_speed, stress.least_sound_speed);
    stress.states->friction.limit_slope(softest.bulk_modulus() / plan.reference_fraction);
    if (s.grains->states->ultradilute &&
        s.grains->states->ultradilute->contacts != IsolatedContactLaw::none)
      plan.isolated_contacts =
          plan_isolated_contacts(s, 2 * std::max(plan.reference_speed_m_s, start));
  }
}

void plan_contact(const Scenario& s, const std::vector<BasalResistance>& bed, ScenePlan& plan) {
  const double dx = s.numerics.spacing_m, h = smoothing_ratio * dx;
  const double start = start_speed(s), deepest = plan.release.max_thickness_m;
  ContactSettings& contact = plan.contact;
  contact.spacing = dx;
  contact.smoothing_length = h;
  contact.reference_density = grains_bulk_density(s, plan);
  const double impact = std::max(plan.reference_speed_m_s, start) / (0.5 * dx);
  contact.stiffness =
      std::max(10 * standard_gravity * std::max(deepest, dx) / (dx * dx), impact * impact);
  contact.restitution = s.basal.restitution.value;
  if (s.grains) contact.internal_friction = plan.stress.law.static_friction;
  contact.zones = plan.zones;
  contact.rasters = plan.rasters;
  contact.bed.clear();
  for (const BasalResistance& b : bed)
    contact.bed.push_back({b.friction_coefficient, b.pore_pressure_ratio, b.cohesion_pa});
}

void plan_full_stress(const Scenario& s, const std::vector<BasalResistance>& bed, ScenePlan& plan) {
  if (s.grains) plan_grain_stress(s, plan);
  plan_contact(s, bed, plan);
  if (!s.fluid) return;
  plan.liquid = plan_liquid(s, plan);
  plan.liquid_contact = liquid_contact(s, plan);
  if (s.grains) plan.coupling = plan_coupling(s);
  plan.dilatancy = plan_dilatancy(s);
}

/// How long a member may last, for a comparison of costs before it is released [s]: its end time,
/// or the longest way at the slowest speed, of which the limit takes four times.
double time_to_weigh(const Scenario& s, const SceneInputs& in, const Raster<double>& thickness) {
  if (s.numerics.end_time_s) return *s.numerics.end_time_s;
  double sum = 0, n = 0;
  for (const double h : thickness.values)
    if (h > 0) sum += h, n += 1;
  const double density = s.grains->density_kg_m3.value * s.grains->solid_fraction.value;
  return 0.25 * time_cap(s, in, n > 0 ? sum / n : 0, density).end_time_s;
}

/// Columns of a periodic ground feel one period and a margin; what is taken is that of the period.
void plan_eroded_bed(const Scenario& s, const SceneInputs& in,
                     const std::vector<BasalResistance>& bed, ScenePlan& plan) {
  if (!s.erosion) return;
  const bool periodic = plan.domain.x.active || plan.domain.y.active;
  plan.erosion = plan_erosion(
      s, in,
      {periodic ? in.terrain_grid() : plan.bed.grid(), plan.bulk_density_kg_m3, bed, plan.zones,
       plan.columns.mixture ? &*plan.columns.mixture : nullptr, plan.rasters});
}

}  // namespace

double pile_share(const Scenario& s, const ScenePlan& plan) {
  if (!s.domain.walls.empty() || !s.domain.periodic.empty() || !(plan.release_narrow_side_m > 0))
    return 0;
  const double aspect = plan.release.median_thickness_m / plan.release_narrow_side_m;
  return std::clamp((aspect - sheet_aspect) / (pile_aspect - sheet_aspect), 0.0, 1.0);
}

bool knows_internal_friction(const DepthAveragedSettings& c) {
  const auto varies = [](const EarthPressure& e) { return e.varies(); };
  const auto acts = [](double spent) { return spent > 0; };
  return std::any_of(c.spent_inside.begin(), c.spent_inside.end(), acts) ||
         std::any_of(c.earth_pressure.begin(), c.earth_pressure.end(), varies);
}

ScenePlan plan_scene(const Scenario& s, const SceneInputs& in, std::int64_t member) {
  require(s.grains || s.fluid,
          "grains: the block is missing (nothing would move). Add `grains:` or `fluid:`.");
  expect(s.domain.periodic.empty() || in.held() == whole_of(in.terrain_grid()),
         "ground that repeats itself is held whole");
  const Domain domain = make_domain(s.domain, *in.elevation);
  require_room(domain.x, "x", s.numerics.spacing_m);
  require_room(domain.y, "y", s.numerics.spacing_m);
  const bool periodic = domain.x.active || domain.y.active;
  Raster<double> thickness = release_thickness(s.release, in);
  FormulationChoice formulation = choose_formulation(s, thickness);
  bool needs_more_ground = false;
  if (s.formulation == Formulation::automatic && !formulation.depth_averaged && !s.fluid) {
    const Terrain weighed = scene_ground(s, in, domain, false);
    weigh_cost(with_typical_bed(s, in), thickness, weighed, time_to_weigh(s, in, thickness),
               formulation);
    needs_more_ground = weighed.needs_more();
  }
  const Terrain ground = scene_ground(s, in, domain, formulation.depth_averaged);

  require(!periodic || s.release.surface == ReleaseSurface::bed,
          "release.surface = pre_failure cannot be used with domain.periodic (the excavation would "
          "not repeat). Use `surface: bed`.");
  ScenePlan plan(s.release.surface == ReleaseSurface::pre_failure
                     ? excavate(ground, thickness, in.terrain_grid())
                     : ground);
  if (needs_more_ground) ask_for_more(plan.bed);
  plan.formulation = formulation;
  plan.domain = domain;

  plan.reference_fraction = s.grains ? s.grains->solid_fraction.value : 0;
  if (s.grains && s.grains->states && !formulation.depth_averaged &&
      plan.reference_fraction < dense_fraction) {
    // A looser mass carries no load: it is deposited as the packing it settles to at once. In a
    // fluid it is the fluid that carries it, and it starts dilated (plan_states).
    if (!s.fluid)
      for (double& h : thickness.values) h *= plan.reference_fraction / dense_fraction;
    plan.reference_fraction = dense_fraction;
  }
  plan.bulk_density_kg_m3 = bulk_density(s, plan.reference_fraction);
  if (formulation.discrete) require_countable_grains(s, thickness);
  plan_masses(
      s, in, thickness, member, [&](double m) { return bulk_density(s, m); }, plan);
  if (formulation.discrete) {
    pack_grains(plan.bed, thickness, grain_packing(s, member), plan.release);
    plan.n_present = plan.release.x.size();
  }
  plan_end(s, in, plan);
  const Window held = in.held();
  plan.zones = {in.zones, in.whole, held.row0, held.col0};
  plan.rasters = plan_bed_rasters(s, in);
  plan.release_narrow_side_m = narrow_side(thickness, in.source_area_m2);
  require_before_walls(plan.release, domain, formulation.depth_averaged);
  if (s.fluid) plan.liquid_start = lay_out_liquid(s, in, plan, thickness, member);
  const std::vector<BasalResistance> bed = basal_by_zone(s.basal);
  if (plan.formulation.depth_averaged) {
    plan_columns(s, bed, plan);
    plan_eroded_bed(s, in, bed, plan);
  } else {
    plan.reference_speed_m_s = expected_speed(s, bed, plan);
    if (formulation.discrete)
      plan_discrete(s, bed, plan);
    else
      plan_full_stress(s, bed, plan);
  }

  plan.available_energy_j = available_energy(s, in, plan);
  return plan;
}

}  // namespace sturz
