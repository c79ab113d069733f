// SPDX-License-Identifier: Apache-2.0
#include "tests/support/liquid/liquid_scene.hpp"

#include "engine/effects/arrivals.hpp"
#include "engine/effects/liquid/effect.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "engine/simulation/parts.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace sturz::test {
namespace {

constexpr double smoothing_ratio = 1.3;

Terrain ground_of(const LiquidBox& box, double cell) {
  const int n = static_cast<int>(std::ceil(2 * box.half_width / cell));
  Raster<double> z(Grid{n, n, -0.5 * n * cell, 0.5 * n * cell, cell, ""});
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      z.at(r, c) = box.ground ? box.ground(z.grid.x_center(c), z.grid.y_center(r))
                              : -box.slope * z.grid.x_center(c);
  return {std::make_shared<Raster<double>>(std::move(z)), NodataRule::outflow};
}

/// \param i,j,k  along the box's edges, in spacings
Vec3 place_of(const LiquidBox& box, double i, double j, double k) {
  const Vec3 edge = box.spacing * Vec3(i, j, k);
  if (!box.along_slope) {
    const double x = box.corner.x() + edge.x();
    return {x, box.corner.y() + edge.y(), box.corner.z() - box.slope * x + edge.z()};
  }
  const double cosine = 1 / std::hypot(1, box.slope), sine = box.slope * cosine;
  return box.corner +
         Vec3(cosine * edge.x() + sine * edge.z(), edge.y(), cosine * edge.z() - sine * edge.x());
}

std::vector<Vec3> lattice_of(const LiquidBox& box) {
  std::vector<Vec3> at;
  for (int i = 0; i < box.n[0]; ++i)
    for (int j = 0; j < box.n[1]; ++j)
      for (int k = 0; k < box.n[2]; ++k) at.push_back(place_of(box, i + 0.5, j + 0.5, k + 0.5));
  return at;
}

void place(const LiquidBox& box, MovingSet& p) {
  p.name = "liquid";
  p.spacing = box.spacing;
  p.bulk_density = box.settings.reference_density;
  p.reference_fraction = 1;
  const std::vector<Vec3> at = box.at.empty() ? lattice_of(box) : box.at;
  p.grow(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    p.x[i] = at[i].x(), p.y[i] = at[i].y(), p.z[i] = at[i].z();
    p.vx[i] = box.velocity.x(), p.vy[i] = box.velocity.y(), p.vz[i] = box.velocity.z();
    p.mass[i] = box.settings.reference_density * std::pow(box.spacing, 3);
    p.ledger.released_mass += p.mass[i];
  }
}

}  // namespace

HandMade liquid_of(const LiquidBox& box) {
  const double cell = box.cell > 0 ? box.cell : 2 * box.spacing;
  HandMade made{State(ground_of(box, cell), box.domain), {}};
  State& s = made.state;
  s.threads = box.threads;
  s.gravity = box.gravity;
  MovingSet& p = s.sets[0];
  place(box, p);
  mark_start(s.domain, p, 0);
  LiquidSettings liquid = box.settings;
  liquid.spacing = box.spacing;
  liquid.smoothing_length = smoothing_ratio * box.spacing;
  liquid.instruction_set = box.instruction_set;
  ContactSettings contact;
  contact.spacing = box.spacing;
  contact.smoothing_length = liquid.smoothing_length;
  contact.reference_density = liquid.reference_density;
  const double height = box.at.empty() ? box.spacing * box.n[2] : box.top - box.corner.z();
  const double speed = 0.1 * liquid.sound_speed;
  contact.stiffness = std::max(10 * s.gravity * height / (box.spacing * box.spacing),
                               std::pow(2 * speed / box.spacing, 2));
  contact.liquid = LiquidContact{box.settings.law, box.bed,
                                 std::vector<bool>(s.domain.walls.size(), box.walls_hold)};
  add_gravity(made.step, s, 0);
  add_terrain_contact(made.step, 0, contact);
  if (!s.domain.walls.empty()) add_wall_contact(made.step, 0, contact);
  std::vector<double> depth(p.size(), 0.0);
  // On a slope the pressure is rho g cos^2 of what lies plumb above.
  const double top = box.corner.z() + height * (box.along_slope ? std::hypot(1, box.slope) : 1);
  for (std::size_t i = 0; box.hydrostatic && i < p.size(); ++i)
    depth[i] = (top - (p.z[i] + box.slope * p.x[i])) / (1 + box.slope * box.slope);
  add_liquid(made.step, s, 0, liquid, depth);
  add_motion(made.step, 0, {box.spacing, liquid.smoothing_length});
  refresh_motion(s, p, 0);
  p.ledger.kinetic_0 = p.ledger.kinetic;
  return made;
}

Simulation simulation_of(const LiquidBox& box, double end_time_s) {
  HandMade made = liquid_of(box);
  StopSettings stop;
  stop.end_time_s = end_time_s;
  stop.stop_at_rest = false;
  RunFacts facts;
  facts.spacing_m = box.spacing;
  const double cell = 2 * box.spacing;
  const int n = static_cast<int>(std::ceil(2 * box.half_width / cell));
  const Grid grid{n, n, -0.5 * n * cell, 0.5 * n * cell, cell, ""};
  return Simulation(std::make_unique<SimulationParts>(
      SimulationParts{std::move(made.state), std::move(made.step),
                      PeakMaps({grid, 0.5 * box.spacing}), StopRule(stop), facts}));
}

}  // namespace sturz::test
