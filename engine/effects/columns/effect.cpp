// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/columns/effect.hpp"

#include "engine/core/error.hpp"
#include "engine/effects/columns/shared.hpp"
#include "engine/effects/motion/wrapping.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Thickness that a column without neighbours gives to itself: the floor at release.
double lone_thickness(double volume, double reach) { return 2.2281692 * volume / (reach * reach); }

void start_columns(State& s, ColumnFlow& flow, std::span<const double> vertical_thickness) {
  ParticleSet& p = s.grains;
  const GroundColumns ground(p);
  auto& thickness = p.find_field("thickness")->component[0];
  auto& reach = p.find_field("reach")->component[0];
  auto& g_n = p.find_field("normal_gravity")->component[0];
  const DepthAveragedSettings& set = flow.settings;
  Field* k = p.find_field("earth_pressure");
  double wave2 = 0, rate = std::sqrt(s.gravity / s.terrain.grid().cell_m);
  s.outside.assign(p.size(), 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    s.outside[i] = !look_up_ground(s, ground, i);
    s.any_outside |= s.outside[i] != 0;
    const Vec3 n = ground[i].normal();
    // A map lattice on a slope stands 1/n_z farther apart along it.
    reach[i] = set.reach_per_spacing * set.spacing * std::min(set.most_reach, std::sqrt(1 / n.z()));
    thickness[i] =
        std::max(vertical_thickness[i] * n.z(), lone_thickness(p.mass[i] / set.density, reach[i]));
    g_n[i] = s.gravity * n.z();
    if (k) {
      const EarthPressure& e = set.earth_pressure[flow.zone_of(s, i)];
      k->component[0][i] = std::clamp(1.0, e.active, e.passive);
    }
    const Vec3 v0(p.vx[i], p.vy[i], p.vz[i]);
    rate = std::max(
        rate, set.base[flow.zone_of(s, i)].rate(v0.norm(), thickness[i], set.density, s.gravity));
    wave2 = std::max(wave2, g_n[i] * thickness[i] * 4 / (reach[i] * reach[i]));
    const Velocity v = Velocity{v0.x(), v0.y(), v0.z()}.turned(ground[i].east, ground[i].north);
    p.vx[i] = v.x, p.vy[i] = v.y, p.vz[i] = v.z;
  }
  flow.fastest_wave = std::sqrt(wave2);
  // A small part of the time to cross a cell in free fall, or to be braked by a viscous base; the
  // least keeps a film that stands from taking for ever.
  flow.start_dt = std::max(0.05 / rate, 1e-5);
}

}  // namespace

ColumnAtWall ColumnFlow::at_wall(ParticleSet& p, std::size_t i) const {
  const Field* k = p.find_field("earth_pressure");
  const double g_n = p.find_field("normal_gravity")->component[0][i];
  return {{p.x[i], p.y[i], p.z[i]},
          GroundColumns(p)[i].normal(),
          p.find_field("reach")->component[0][i],
          p.find_field("thickness")->component[0][i],
          k ? k->component[0][i] * g_n : g_n};
}

bool look_up_ground(State& s, const GroundColumns& ground, std::size_t i) {
  ParticleSet& p = s.grains;
  double x = p.x[i], y = p.y[i], z = 0;
  s.domain.wrap(x, y, z);
  const CurvedSurface g = s.terrain.curved(x, y);
  // Seen from its image a column stands as much higher as wrapping lowers it.
  p.z[i] = g.z - z;
  ground.set(i, g);
  return g.known;
}

void add_depth_averaged(Step& step, State& state, const DepthAveragedSettings& settings,
                        std::span<const double> thickness) {
  expect(thickness.size() == state.grains.size(), "one thickness per column");
  expect(!settings.base.empty() && settings.base.size() == settings.earth_pressure.size(),
         "base and earth pressure for every zone");
  ParticleSet& p = state.grains;
  for (const char* name : {"thickness", "reach", "normal_gravity", "turning"}) p.add_field(name, 1);
  p.add_field("ground", 5);
  p.add_field("velocity_before", 3);
  const auto varies = [](const EarthPressure& e) { return e.varies(); };
  if (std::any_of(settings.earth_pressure.begin(), settings.earth_pressure.end(), varies))
    p.add_field("earth_pressure", 1);
  for (auto* a : {&state.ax, &state.ay, &state.az}) a->assign(p.size(), 0.0f);
  prepare_wrapping(state);
  auto flow = std::make_shared<ColumnFlow>(settings);
  start_columns(state, *flow, thickness);
  add_column_pressure(step, flow);
  add_column_motion(step, flow);
}

}  // namespace sturz
