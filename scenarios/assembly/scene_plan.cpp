// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/scene_plan.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/laws/grain_states.hpp"
#include "engine/simulation/reference_speed.hpp"
#include "scenarios/assembly/ground.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz {
namespace {

constexpr double smoothing_ratio = 1.3;  // h/dx, docs/physics.md B.1

/// The member's release thickness [m] on the working grid.
Raster<double> release_thickness(const ReleaseSpec& spec, const SceneInputs& in) {
  Raster<double> thickness = *in.release;
  double scale = 1;
  if (in.pattern == ReleasePattern::cover && spec.thickness_m) scale = spec.thickness_m->value;
  if (spec.volume_m3) {
    double sum = 0;
    for (double h : thickness.values)
      if (h > 0) sum += h;
    const double volume = sum * thickness.grid.cell_m * thickness.grid.cell_m;
    require(volume > 0, "release: the source covers no cell. Check that it lies on the terrain.");
    scale = spec.volume_m3->value / volume;
  }
  for (double& h : thickness.values) h = h > 0 ? h * scale : 0;
  return thickness;
}

/// bed = pre-failure surface - thickness, as a patch over the shared raster.
Terrain excavate(const Terrain& ground, const Raster<double>& fine_thickness) {
  const Grid& g = ground.grid();
  const int factor = static_cast<int>(std::lround(g.cell_m / fine_thickness.grid.cell_m));
  const Raster<double> thickness = factor > 1 ? coarsened(fine_thickness, factor) : fine_thickness;
  int r0 = g.n_rows, r1 = -1, c0 = g.n_cols, c1 = -1;
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c)
      if (thickness.at(r, c) > 0) {
        r0 = std::min(r0, r), r1 = std::max(r1, r);
        c0 = std::min(c0, c), c1 = std::max(c1, c);
      }
  if (r1 < 0) return ground;
  std::vector<double> patch;
  for (int r = r0; r <= r1; ++r)
    for (int c = c0; c <= c1; ++c) {
      const double h = thickness.at(r, c);
      patch.push_back(h > 0 ? ground.node(r, c) - h : nan_d);
    }
  return ground.with_patch(r0, c0, r1 - r0 + 1, c1 - c0 + 1, std::move(patch));
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
              short_number(spacing) + " m). Use a longer terrain or a finer spacing_m.");
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

MuIRheology make_law(const GrainsSpec& g) {
  MuIRheology law;
  if (g.friction_angle_deg) {
    law.static_friction = law.dynamic_friction =
        std::tan(g.friction_angle_deg->value * std::numbers::pi / 180);
  } else {
    const FrictionLaw f = g.friction.value_or(FrictionLaw{});
    law.static_friction = f.static_coefficient.value;
    law.dynamic_friction = std::max(f.dynamic_coefficient.value, law.static_friction);
    law.inertial_number_scale = f.inertial_number_scale.value;
  }
  law.grain_diameter = g.diameter_m.value;
  law.grain_density = g.density_kg_m3.value;
  law.cohesion = g.cohesion_pa.value;
  return law;
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
  std::vector<BasalResistance> bed{all};
  for (const BasalZone& zone : spec.zones) {
    BasalResistance& b = bed.emplace_back(all);
    b.friction_coefficient = zone.friction_coefficient.value_or(b.friction_coefficient);
    b.pore_pressure_ratio = zone.pore_pressure_ratio.value_or(b.pore_pressure_ratio);
    b.cohesion_pa = zone.cohesion_pa.value_or(b.cohesion_pa);
  }
  return bed;
}

void plan_columns(const Scenario& s, std::vector<BasalResistance> bed, ScenePlan& plan) {
  DepthAveragedSettings& c = plan.columns;
  c.spacing = s.numerics.spacing_m;
  c.density = plan.bulk_density_kg_m3;
  c.courant = s.numerics.courant;
  c.zones = plan.zones;
  c.instruction_set = best_instruction_set();
  c.earth_pressure.assign(bed.size(), EarthPressure{});
  if (s.grains->earth_pressure == LateralPressure::active_passive) {
    const double internal = make_law(*s.grains).static_friction;
    for (std::size_t k = 0; k < bed.size(); ++k)
      // Only the grains' part of the stress is anisotropic (Iverson & Denlinger 2001).
      c.earth_pressure[k] = EarthPressure(internal, bed[k].effective_friction())
                                .with_pore_pressure(bed[k].pore_pressure_ratio);
  }
  c.bed = std::move(bed);
}

/// Grains that may part: reference packing and laws (docs/physics.md A.4, A.7, B.9).
GrainStatesSettings plan_states(const Scenario& s, double reference_fraction) {
  const GrainStatesSpec& spec = *s.grains->states;
  GrainStatesSettings states;
  states.reference_fraction = reference_fraction;
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

void plan_full_stress(const Scenario& s, const std::vector<BasalResistance>& bed, ScenePlan& plan) {
  const double dx = s.numerics.spacing_m, h = smoothing_ratio * dx;
  double least_friction = bed[0].effective_friction();
  for (const BasalResistance& b : bed)
    least_friction = std::min(least_friction, b.effective_friction());
  const auto& v0 = s.release.velocity_m_s;
  const double start = std::sqrt(v0[0] * v0[0] + v0[1] * v0[1] + v0[2] * v0[2]);
  const double deepest = plan.release.max_thickness_m;
  plan.reference_speed_m_s =
      reference_speed(plan.bed, plan.release, least_friction, start, s.numerics.end_time_s);

  GrainStressSettings& stress = plan.stress;
  stress.law = make_law(*s.grains);
  stress.spacing = dx;
  stress.smoothing_length = h;
  stress.reference_density = plan.bulk_density_kg_m3;
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

  ContactSettings& contact = plan.contact;
  contact.spacing = dx;
  contact.smoothing_length = h;
  contact.reference_density = plan.bulk_density_kg_m3;
  const double impact = std::max(plan.reference_speed_m_s, start) / (0.5 * dx);
  contact.stiffness =
      std::max(10 * standard_gravity * std::max(deepest, dx) / (dx * dx), impact * impact);
  contact.restitution = s.basal.restitution.value;
  contact.zones = plan.zones;
  contact.bed.clear();
  for (const BasalResistance& b : bed)
    contact.bed.push_back({b.friction_coefficient, b.pore_pressure_ratio, b.cohesion_pa});
}

/// Four layers or more on the whole, or a reader has to be told what is not resolved.
void warn_of_thin_flow(const Scenario& s, const ScenePlan& plan, std::vector<std::string>& out) {
  const FormulationChoice& f = plan.formulation;
  if (f.depth_averaged || f.layers >= resolved_layers) return;
  out.push_back("thin flow: " + short_number(f.layers) + " layers of particles resolve the " +
                (f.release_layers <= f.deposit_layers ? "release" : "expected deposit") +
                " (fewer than 4). Centre of mass and speed hold, the footprint may be wrong by "
                "15-100 %. Use formulation: auto or a spacing below " +
                short_number(s.numerics.spacing_m * f.layers / resolved_layers) + " m");
}

}  // namespace

ScenePlan plan_scene(const Scenario& s, const SceneInputs& in, std::int64_t member) {
  require(s.grains.has_value(),
          "grains: the block is missing (nothing would move). Add `grains:`.");
  const Domain domain = make_domain(s.domain, *in.elevation);
  require_room(domain.x, "x", s.numerics.spacing_m);
  require_room(domain.y, "y", s.numerics.spacing_m);
  const bool periodic = domain.x.active || domain.y.active;
  Raster<double> thickness = release_thickness(s.release, in);
  const FormulationChoice formulation = choose_formulation(s, thickness);
  const Terrain ground = scene_ground(s, in, domain, formulation.depth_averaged);

  require(!periodic || s.release.surface == ReleaseSurface::bed,
          "release.surface = pre_failure cannot be used with domain.periodic (the excavation would "
          "not repeat). Use `surface: bed`.");
  ScenePlan plan(s.release.surface == ReleaseSurface::pre_failure ? excavate(ground, thickness)
                                                                  : ground);
  plan.formulation = formulation;
  plan.domain = domain;

  plan.reference_fraction = s.grains->solid_fraction.value;
  if (s.grains->states && !formulation.depth_averaged && plan.reference_fraction < dense_fraction) {
    // A looser mass carries no load: it is deposited as the packing it settles to at once.
    for (double& h : thickness.values) h *= plan.reference_fraction / dense_fraction;
    plan.reference_fraction = dense_fraction;
  }
  plan.bulk_density_kg_m3 = s.grains->density_kg_m3.value * plan.reference_fraction;
  plan.release =
      release_particles(plan.bed, thickness,
                        {s.numerics.spacing_m, plan.bulk_density_kg_m3, s.numerics.jitter,
                         s.ensemble.seed, member, plan.formulation.depth_averaged});
  plan.zones = {in.zones};
  const std::vector<BasalResistance> bed = basal_by_zone(s.basal);
  if (plan.formulation.depth_averaged)
    plan_columns(s, bed, plan);
  else
    plan_full_stress(s, bed, plan);

  const auto& v0 = s.release.velocity_m_s;
  const double start = std::sqrt(v0[0] * v0[0] + v0[1] * v0[1] + v0[2] * v0[2]);
  double mass = 0, height = 0, lowest = 1e300;
  for (std::size_t i = 0; i < plan.release.x.size(); ++i) {
    mass += plan.release.mass[i];
    height += plan.release.mass[i] * plan.release.z[i];
  }
  for (double z : in.elevation->values)
    if (std::isfinite(z)) lowest = std::min(lowest, z);
  plan.available_energy_j =
      standard_gravity * (height - mass * lowest) + 0.5 * mass * start * start;
  return plan;
}

std::vector<std::string> plan_warnings(const Scenario& s, const ScenePlan& plan) {
  std::vector<std::string> out;
  const double dx = s.numerics.spacing_m;
  warn_of_thin_flow(s, plan, out);
  if (!plan.formulation.depth_averaged &&
      2 * plan.stress.smoothing_length < 4 * s.grains->diameter_m.value)
    out.push_back("coarse grains: the smoothing length of " +
                  short_number(plan.stress.smoothing_length) +
                  " m is under two grain diameters of " + short_number(s.grains->diameter_m.value) +
                  " m: the grains act as a parameter only");
  if (s.grains->states && plan.formulation.depth_averaged)
    out.emplace_back(
        "grains.states is not used: columns have no states. Use formulation: full_stress "
        "where the grains may disperse");
  const bool collides =
      s.grains->states && s.grains->states->dilute && !plan.formulation.depth_averaged;
  if (collides && s.grains->states->dilute->restitution.value < 0.7)
    out.push_back("grains.states.dilute.restitution = " +
                  short_number(s.grains->states->dilute->restitution.value) +
                  " lies under 0.7, where kinetic theory was not made for");
  if (plan.release.dropped_fraction > 0.01)
    out.push_back(
        "thin edge: " + short_number(100 * plan.release.dropped_fraction) +
        " % of the release lies where it is too thin for a particle and was given to the others");
  // Columns thin out continuously; particles do not.
  for (double threshold : s.hazard.thickness_m)
    if (!plan.formulation.depth_averaged && threshold < 0.5 * dx) {
      out.push_back("thickness thresholds under " + short_number(0.5 * dx) +
                    " m (half a spacing) are not resolved");
      break;
    }
  return out;
}

}  // namespace sturz
