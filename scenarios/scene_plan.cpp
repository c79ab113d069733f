// SPDX-License-Identifier: Apache-2.0
#include "scenarios/scene_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/error.hpp"
#include "engine/simulation/reference_speed.hpp"
#include "scenarios/number_text.hpp"

namespace sturz {
namespace {

constexpr double smoothing_ratio = 1.3;  // h/dx, physics.md B.1

/// Three significant digits, enough for a warning.
std::string short_number(double v) {
  if (v == 0 || !std::isfinite(v)) return number_text(v);
  const double unit = std::pow(10, std::floor(std::log10(std::abs(v))) - 2);
  return number_text(unit < 1 ? std::round(v / unit) / std::round(1 / unit)
                              : std::round(v / unit) * unit);
}

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
Terrain excavate(const Terrain& ground, const Raster<double>& thickness) {
  const Grid& g = thickness.grid;
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

/// A margin of repeated ground, so that the surface exists up to the period's edge.
std::shared_ptr<const Raster<double>> with_margin(const Raster<double>& z, const Domain& d) {
  const int mx = d.x.active ? 2 : 0, my = d.y.active ? 2 : 0;
  Grid g = z.grid;
  g.west_m -= mx * g.cell_m;
  g.north_m += my * g.cell_m;
  g.n_cols += 2 * mx;
  g.n_rows += 2 * my;
  auto out = std::make_shared<Raster<double>>(g);
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) {
      const int rr = r - my, cc = c - mx;
      const int row = (rr + z.grid.n_rows) % z.grid.n_rows, col = (cc + z.grid.n_cols) % z.grid.n_cols;
      double shift = 0;
      if (cc < 0) shift -= d.x.rise;
      if (cc >= z.grid.n_cols) shift += d.x.rise;
      if (rr >= z.grid.n_rows) shift -= d.y.rise;  // rows run southward
      if (rr < 0) shift += d.y.rise;
      out->at(r, c) = z.at(row, col) + shift;
    }
  return out;
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

}  // namespace

ScenePlan plan_scene(const Scenario& s, const SceneInputs& in, std::int64_t member) {
  require(s.grains.has_value(), "grains: the block is missing (nothing would move). Add `grains:`.");
  const Domain domain = make_domain(s.domain, *in.elevation);
  require_room(domain.x, "x", s.numerics.spacing_m);
  require_room(domain.y, "y", s.numerics.spacing_m);
  const bool periodic = domain.x.active || domain.y.active;
  const NodataRule rule = s.terrain.nodata == "wall" ? NodataRule::wall : NodataRule::outflow;
  const Terrain ground(periodic ? with_margin(*in.elevation, domain) : in.elevation, rule);
  const Raster<double> thickness = release_thickness(s.release, in);

  require(!periodic || s.release.surface == "bed",
          "release.surface = pre_failure cannot be used with domain.periodic (the excavation would "
          "not repeat). Use `surface: bed`.");
  ScenePlan plan(s.release.surface == "pre_failure" ? excavate(ground, thickness) : ground);
  plan.domain = domain;

  const double dx = s.numerics.spacing_m, h = smoothing_ratio * dx;
  const double density = s.grains->density_kg_m3.value * s.grains->solid_fraction.value;
  plan.release = release_particles(plan.bed, thickness,
                                   {dx, density, s.numerics.jitter, s.ensemble.seed, member});

  const double effective = s.basal.friction_coefficient.value * (1 - s.basal.pore_pressure_ratio.value);
  const auto& v0 = s.release.velocity_m_s;
  const double start = std::sqrt(v0[0] * v0[0] + v0[1] * v0[1] + v0[2] * v0[2]);
  const double deepest = plan.release.max_thickness_m;
  plan.reference_speed_m_s =
      reference_speed(plan.bed, plan.release, effective, start, s.numerics.end_time_s);

  GrainStressSettings& stress = plan.stress;
  stress.law = make_law(*s.grains);
  stress.spacing = dx;
  stress.smoothing_length = h;
  stress.reference_density = density;
  stress.poisson_ratio = s.grains->poisson_ratio.value;
  stress.viscosity = s.numerics.artificial_viscosity;
  stress.density_diffusion = s.numerics.density_diffusion;
  stress.courant = s.numerics.courant;
  stress.instruction_set = best_instruction_set();
  // c0 >= 10 v_ref keeps the density within about 1 % in motion, and K = rho c0^2/(1 + 4G/3K)
  // >= 100 rho g H does so at rest (physics.md B.5).
  const double at_rest = std::sqrt((1 + 4.0 / 3 * stress.shear_to_bulk()) * 9.81 * deepest);
  stress.sound_speed =
      s.numerics.sound_speed_factor * std::max({plan.reference_speed_m_s, at_rest, start});

  ContactSettings& contact = plan.contact;
  contact.spacing = dx;
  contact.smoothing_length = h;
  contact.reference_density = density;
  const double impact = std::max(plan.reference_speed_m_s, start) / (0.5 * dx);
  contact.stiffness = std::max(10 * 9.81 * std::max(deepest, dx) / (dx * dx), impact * impact);
  contact.restitution = s.basal.restitution.value;
  contact.friction_coefficient = s.basal.friction_coefficient.value;
  contact.pore_pressure_ratio = s.basal.pore_pressure_ratio.value;
  contact.cohesion_pa = s.basal.cohesion_pa.value;

  double mass = 0, height = 0, lowest = 1e300;
  for (std::size_t i = 0; i < plan.release.x.size(); ++i) {
    mass += plan.release.mass[i];
    height += plan.release.mass[i] * plan.release.z[i];
  }
  for (double z : in.elevation->values)
    if (std::isfinite(z)) lowest = std::min(lowest, z);
  plan.available_energy_j = 9.81 * (height - mass * lowest) + 0.5 * mass * start * start;
  return plan;
}

std::vector<std::string> plan_warnings(const Scenario& s, const ScenePlan& plan) {
  std::vector<std::string> out;
  const double dx = s.numerics.spacing_m;
  if (plan.release.layers < thin_layers)
    out.push_back("thin flow: " + short_number(plan.release.layers) +
                  " layers of particles resolve the release (fewer than 3). Centre of mass and "
                  "speed hold, the footprint may be wrong by 15-100 %. Use a spacing below " +
                  short_number(plan.release.median_thickness_m / thin_layers) + " m");
  if (2 * plan.stress.smoothing_length < 4 * s.grains->diameter_m.value)
    out.push_back("coarse grains: the smoothing length of " +
                  short_number(plan.stress.smoothing_length) + " m is under two grain diameters of " +
                  short_number(s.grains->diameter_m.value) + " m: the grains act as a parameter only");
  if (plan.release.dropped_fraction > 0.01)
    out.push_back("thin edge: " + short_number(100 * plan.release.dropped_fraction) +
                  " % of the release lies in columns under 0.2 spacings and was given to the others");
  for (double threshold : s.hazard.thickness_m)
    if (threshold < 0.5 * dx) {
      out.push_back("thickness thresholds under " + short_number(0.5 * dx) +
                    " m (half a spacing) are not resolved");
      break;
    }
  return out;
}

}  // namespace sturz
