// SPDX-License-Identifier: Apache-2.0
#include "tests/support/hand_made.hpp"

#include "engine/effects/motion/accounts.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace sturz::test {
namespace {

constexpr double density = 1560, h = 1.3;

State state_of(Terrain ground, const std::vector<Vec3>& positions, const Vec3& velocity,
               const Domain& domain, double mass = density) {
  State s(std::move(ground), domain);
  MovingSet& p = s.grains();
  p.grow(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    p.x[i] = positions[i].x(), p.y[i] = positions[i].y(), p.z[i] = positions[i].z();
    p.vx[i] = velocity.x(), p.vy[i] = velocity.y(), p.vz[i] = velocity.z();
    p.mass[i] = mass;
    s.grains().ledger.released_mass += mass;
  }
  return s;
}

void open_ledger(State& s) {
  refresh_motion(s, s.grains(), 0);
  s.grains().ledger.kinetic_0 = s.grains().ledger.kinetic;
}

void finish(HandMade& made, std::vector<GroundFriction> bed, ZoneMap zones,
            BedRasters rasters = {}) {
  add_gravity(made.step, made.state, 0);
  ContactSettings contact;
  contact.reference_density = density;
  contact.stiffness = 4000;
  contact.bed = std::move(bed);
  contact.zones = std::move(zones);
  contact.rasters = std::move(rasters);
  add_terrain_contact(made.step, 0, contact);
  if (!made.state.domain.walls.empty()) add_wall_contact(made.step, 0, contact);
  add_motion(made.step, 0, {1, h});
  open_ledger(made.state);
}

}  // namespace

Terrain even_ground(int n, double slope, NodataRule rule) {
  Raster<double> z(Grid{n, n, -0.5 * n, 0.5 * n, 1, ""});
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) z.at(r, c) = -slope * z.grid.x_center(c);
  return Terrain(std::make_shared<Raster<double>>(std::move(z)), rule);
}

double HandMade::advance() {
  const double dt =
      std::min(step.limit(state).dt, 1.05 * (state.previous_dt > 0 ? state.previous_dt : 1e300));
  step.apply(state, dt);
  return dt;
}

std::vector<Vec3> block(std::array<int, 3> n, const Vec3& corner) {
  std::vector<Vec3> positions;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k) positions.push_back(corner + Vec3(i + 0.5, j + 0.5, k + 0.5));
  return positions;
}

HandMade grains_on(Terrain ground, const std::vector<Vec3>& positions, const Vec3& velocity,
                   const Domain& domain, double friction) {
  HandMade made{state_of(std::move(ground), positions, velocity, domain), {}};
  GrainStressSettings settings;
  settings.smoothing_length = h;
  settings.reference_density = density;
  settings.sound_speed = 60;
  settings.instruction_set = best_instruction_set();
  double top = 0;
  for (const Vec3& p : positions) top = std::max(top, p.z() + 0.5);
  std::vector<double> depth;
  for (const Vec3& p : positions) depth.push_back(top - p.z());
  add_grain_stress(made.step, made.state, 0, settings, depth);
  finish(made, {{friction}}, {});
  return made;
}

HandMade particles_on(Terrain ground, const std::vector<Vec3>& positions, const Vec3& velocity,
                      const Domain& domain, double friction) {
  return particles_on_zones(std::move(ground), positions, velocity, domain, {{friction}}, {});
}

HandMade particles_on_zones(Terrain ground, const std::vector<Vec3>& positions,
                            const Vec3& velocity, const Domain& domain,
                            std::vector<GroundFriction> bed, ZoneMap zones) {
  HandMade made{state_of(std::move(ground), positions, velocity, domain), {}};
  finish(made, std::move(bed), std::move(zones));
  return made;
}

HandMade particles_on_rasters(Terrain ground, const std::vector<Vec3>& positions,
                              const Vec3& velocity, std::vector<GroundFriction> bed,
                              BedRasters rasters) {
  HandMade made{state_of(std::move(ground), positions, velocity, {}), {}};
  finish(made, std::move(bed), {}, std::move(rasters));
  return made;
}

HandMade columns_on(Terrain ground, const std::vector<Vec3>& positions, double thickness,
                    const Vec3& velocity, const Domain& domain, DepthAveragedSettings settings) {
  HandMade made{state_of(std::move(ground), positions, velocity, domain, density * thickness), {}};
  settings.density = density;
  settings.instruction_set = best_instruction_set();
  add_depth_averaged(made.step, made.state, 0, settings,
                     std::vector<double>(positions.size(), thickness));
  open_ledger(made.state);
  return made;
}

}  // namespace sturz::test
