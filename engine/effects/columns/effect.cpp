// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/columns/effect.hpp"

#include "engine/core/error.hpp"
#include "engine/effects/arrivals.hpp"
#include "engine/effects/columns/mixture.hpp"
#include "engine/effects/columns/shared.hpp"
#include "engine/particles/column_area.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Thickness that a column without neighbours gives to itself: the floor at release.
double single_thickness(double volume, double support_radius) {
  return 2.2281692 * volume / (support_radius * support_radius);
}

/// Rates that set the length of the first step [1/s].
struct FirstRates {
  double wave2 = 0;  ///< of waves, squared [1/s^2]
  double rate = 0;   ///< of free fall over a cell, or of a viscous bed
};

/// Puts column i on the ground with the thickness that it was released with.
void start_column(const State& s, MovingSet& p, ColumnFlow& flow, std::size_t i,
                  double vertical_thickness, FirstRates& first) {
  const GroundColumns ground(p);
  const DepthAveragedSettings& set = flow.settings;
  const bool known = look_up_ground(s, p, ground, i);
  p.fate[i] = known ? Fate::stays : Fate::off_terrain;
  p.any_leaving |= !known;
  const Vec3 n = ground[i].normal();
  const double slope2 = ground[i].slope2(), share = known_share(slope2);
  const double known_z = share < 1 ? 1 / std::sqrt(1 + share * share * slope2) : n.z();
  // A map lattice on a slope stands 1/n_z farther apart along it.
  const double support_radius =
      set.radius_per_spacing * set.spacing * std::min(set.most_radius, std::sqrt(1 / known_z));
  const double known_thickness = std::max(
      vertical_thickness * known_z, single_thickness(p.mass[i] / set.density, support_radius));
  const double thickness = known_thickness * thinned(share, slope2);
  const double g_n = s.gravity * n.z();
  p.scalar(fields::support_radius)[i] = support_radius;
  p.scalar(fields::thickness)[i] = thickness;
  p.scalar(fields::normal_gravity)[i] = g_n;
  if (set.mixture) start_pressure(p, *set.mixture, i);
  if (Field* k = p.find(fields::earth_pressure)) {
    const EarthPressure e = flow.earth_pressure_of(s.domain, p, i);
    k->component[0][i] = std::clamp(1.0, e.active, e.passive);
  }
  // The ground takes what points into it at once; what points out of it lifts no column.
  const Velocity v = Velocity{p.vx[i], p.vy[i], p.vz[i]}.in_plane(ground[i].east, ground[i].north);
  BasalResistance own;
  const BasalResistance& bed = flow.bed_of(s.domain, p, i, own);
  first.rate =
      std::max(first.rate, bed.rate(std::sqrt(v.norm2()), thickness, set.density, s.gravity));
  first.wave2 = std::max(
      first.wave2, s.gravity * known_z * known_thickness * 4 / (support_radius * support_radius));
  flow.release_thickness = std::max(flow.release_thickness, vertical_thickness);
  flow.release_top =
      std::max(flow.release_top, p.z[i] + thickness / n.z() + 0.5 * v.norm2() / s.gravity);
  p.vx[i] = v.x, p.vy[i] = v.y, p.vz[i] = v.z;
}

/// A column stands for the part of its lattice cell that the source covers.
void mark_area(MovingSet& p, const DepthAveragedSettings& set, std::size_t i, double covered) {
  p.scalar(fields::area_share)[i] =
      covered * set.spacing * set.spacing /
      column_area(p.scalar(fields::support_radius)[i], GroundColumns(p)[i].normal().z(),
                  p.mass[i] / set.density, p.scalar(fields::thickness)[i]);
}

void start_columns(const State& s, MovingSet& p, ColumnFlow& flow,
                   std::span<const double> vertical_thickness) {
  FirstRates first;
  first.rate = std::sqrt(s.gravity / s.terrain.grid().cell_m);
  p.fate.assign(p.size(), Fate::stays);
  for (std::size_t i = 0; i < p.size(); ++i)
    start_column(s, p, flow, i, vertical_thickness[i], first);
  flow.fastest_wave = std::sqrt(first.wave2);
  // A small part of the time to cross a cell in free fall, or to be braked by a viscous bed; the
  // least keeps a film that stands from taking for ever.
  flow.start_dt = std::max(0.05 / first.rate, 1e-5);
}

}  // namespace

ColumnAtWall ColumnFlow::at_wall(ParticleSet& p, std::size_t i) const {
  const Field* k = p.find(fields::earth_pressure);
  const double g = lateral_gravity[i];
  const ColumnGround ground = GroundColumns(p)[i];
  return {{p.x[i], p.y[i], p.z[i]},
          ground.normal(),
          p.scalar(fields::support_radius)[i],
          p.scalar(fields::thickness)[i] / thinned(share[i], ground.slope2()),
          k ? known_earth_pressure(k->component[0][i], share[i]) * g : g};
}

bool look_up_ground(const State& s, ParticleSet& p, const GroundColumns& ground, std::size_t i) {
  double x = p.x[i], y = p.y[i], z = 0;
  s.domain.wrap(x, y, z);
  const CurvedSurface g = s.terrain.curved(x, y);
  // Seen from its image a column stands as much higher as wrapping lowers it.
  p.z[i] = g.z - z;
  ground.set(i, g);
  return g.known;
}

void enter_columns(const State& s, ColumnFlow& flow, MovingSet& p, std::size_t first) {
  p.fate.resize(p.size());
  if (flow.settings.mixture) enter_mixture(p, *flow.settings.mixture, first, p.entering);
  FirstRates rates;
  for (std::size_t i = first; i < p.size(); ++i) {
    const Arrival& a = p.entering[i - first];
    start_column(s, p, flow, i, a.thickness, rates);
    if (!a.released) continue;
    mark_area(p, flow.settings, i, a.covered);
    if (s.n_steps >= flow.settle_until) flow.settle_from = p.id[i];
    flow.settle_until = s.n_steps + ColumnFlow::settling_steps;
  }
  flow.fastest_wave = std::max(flow.fastest_wave, std::sqrt(rates.wave2));
}

std::size_t column_bytes_per_particle() { return 48 + 2 * 40 + 7 * 4 + 16; }

std::shared_ptr<ColumnFlow> add_depth_averaged(Step& step, State& state, std::size_t set,
                                               const DepthAveragedSettings& settings,
                                               std::span<const double> thickness,
                                               std::span<const double> covered) {
  MovingSet& p = state.sets[set];
  expect(thickness.size() == p.size(), "one thickness per column");
  expect(covered.empty() || covered.size() == p.size(), "one cover per column");
  expect(!settings.bed.empty() && settings.bed.size() == settings.earth_pressure.size(),
         "bed and earth pressure for every zone");
  const auto fluid = [](const BasalResistance& b) {
    return b.pore_pressure_ratio > 0 || b.viscosity_pa_s > 0 || b.yield_stress_pa > 0 || b.samosat;
  };
  const bool wet_bed = std::any_of(settings.bed.begin(), settings.bed.end(), fluid) ||
                       settings.rasters.has(BedNumber::pore_pressure);
  expect(!settings.mixture || !wet_bed, "a mixture has its own pore pressure and viscosity");
  for (const FieldKey* key :
       {&fields::thickness, &fields::support_radius, &fields::area_share, &fields::normal_gravity,
        &fields::centripetal_momentum, &fields::ground, &fields::velocity_before})
    p.add(*key);
  const auto varies = [](const EarthPressure& e) { return e.varies(); };
  if (std::any_of(settings.earth_pressure.begin(), settings.earth_pressure.end(), varies) ||
      (settings.rasters.any() && settings.active_passive))
    p.add(fields::earth_pressure);
  for (auto* a : {&p.ax, &p.ay, &p.az}) a->assign(p.size(), 0.0f);
  mark_start(state.domain, p, 0);
  auto flow = std::make_shared<ColumnFlow>(set, settings);
  start_columns(state, p, *flow, thickness);
  for (std::size_t i = 0; i < covered.size(); ++i) mark_area(p, settings, i, covered[i]);
  add_column_pressure(step, flow);
  add_column_bed(step, flow);
  add_column_motion(step, flow);
  return flow;
}

}  // namespace sturz
