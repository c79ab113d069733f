// SPDX-License-Identifier: Apache-2.0
#include "tests/support/liquid/immersed_grains.hpp"

#include "engine/effects/arrivals.hpp"
#include "engine/effects/coupling/effect.hpp"
#include "engine/effects/dilatancy/effect.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/liquid/effect.hpp"
#include "engine/effects/motion/accounts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace sturz::test {
namespace {

constexpr double smoothing_ratio = 1.3;

State level_state(const ImmersedGrains& g) {
  const double cell = 2 * g.spacing, longest = std::max(g.liquid_length, g.grain_length) + g.reach;
  const int n = static_cast<int>(std::ceil(2 * longest / cell)) + 8;
  Raster<double> z(Grid{n, n, -0.5 * n * cell, 0.5 * n * cell, cell, ""});
  Domain d;
  d.y = {true, 0, g.across * g.spacing, 0};
  if (g.walled) {
    Wall left, right;
    left.normal = {1, 0, 0};
    right.point = {g.liquid_length, 0, 0}, right.normal = {-1, 0, 0};
    d.walls = {left, right};
  } else {
    d.x = {true, 0, g.liquid_length, 0};
  }
  return {Terrain(std::make_shared<Raster<double>>(std::move(z)), NodataRule::outflow), d};
}

void fill(const ImmersedGrains& g, MovingSet& p, double length, double height, double density) {
  const double dx = g.spacing;
  const auto nx = static_cast<int>(std::lround(length / dx));
  const auto nz = static_cast<int>(std::lround(height / dx));
  p.grow(static_cast<std::size_t>(nx) * static_cast<std::size_t>(g.across) *
         static_cast<std::size_t>(nz));
  std::size_t at = 0;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < g.across; ++j)
      for (int k = 0; k < nz; ++k, ++at) {
        p.x[at] = (i + 0.5) * dx, p.y[at] = (j + 0.5) * dx, p.z[at] = (k + 0.5) * dx;
        p.mass[at] = density * dx * dx * dx;
      }
  p.spacing = dx;
  p.bulk_density = density;
}

void count_release(State& s) {
  for (MovingSet& p : s.sets) {
    mark_start(s.domain, p, 0);
    for (const double m : p.mass) p.ledger.released_mass += m;
  }
}

void place(const ImmersedGrains& g, State& s) {
  s.sets.resize(2);
  MovingSet &grains = s.sets[0], &liquid = s.sets[1];
  fill(g, grains, g.grain_length, g.grain_height, g.solid_fraction * g.grain_density);
  grains.reference_fraction = g.solid_fraction;
  grains.vx.assign(grains.size(), g.slip.x());
  grains.vy.assign(grains.size(), g.slip.y());
  grains.vz.assign(grains.size(), g.slip.z());
  fill(g, liquid, g.liquid_length, g.liquid_height, g.liquid_density);
  liquid.name = "liquid";
  for (std::size_t i = 0; i < liquid.size(); ++i)
    if (liquid.x[i] < g.grain_length && liquid.z[i] < g.grain_height)
      liquid.mass[i] *= 1 - g.solid_fraction;
  count_release(s);
}

ContactSettings contact_of(const ImmersedGrains& g, double density, double friction) {
  ContactSettings c;
  c.spacing = g.spacing;
  c.smoothing_length = smoothing_ratio * g.spacing;
  c.reference_density = density;
  c.stiffness = std::max(10 * standard_gravity * g.liquid_height / (g.spacing * g.spacing),
                         std::pow(0.2 * g.sound_speed / g.spacing, 2));
  c.bed = {{friction}};
  return c;
}

std::vector<double> liquid_depth(const ImmersedGrains& g, const MovingSet& p) {
  const double submerged =
      g.solid_fraction * (g.grain_density - g.liquid_density) / g.liquid_density;
  std::vector<double> depth;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double borne =
        p.x[i] < g.grain_length ? submerged * std::max(0.0, g.grain_height - p.z[i]) : 0;
    depth.push_back(g.liquid_height - p.z[i] + g.liquefied * borne);
  }
  return depth;
}

}  // namespace

HandMade immersed(const ImmersedGrains& g) {
  HandMade made{level_state(g), {}};
  State& s = made.state;
  s.threads = g.threads;
  s.gravity = g.gravity;
  place(g, s);
  const double h = smoothing_ratio * g.spacing;
  for (const std::size_t set : {0, 1}) add_gravity(made.step, s, set);
  const ContactSettings wet = contact_of(g, g.liquid_density, 0);
  ContactSettings dry = contact_of(g, g.solid_fraction * g.grain_density, g.friction);
  add_terrain_contact(made.step, 1, wet);
  if (g.coupled) add_coupling_fields(s, 1);
  GrainStressSettings grains;
  grains.spacing = g.spacing, grains.smoothing_length = h;
  grains.reference_density = g.solid_fraction * g.grain_density;
  grains.sound_speed = g.grain_sound_speed > 0 ? g.grain_sound_speed : g.sound_speed;
  grains.law.grain_density = g.grain_density;
  grains.law.grain_diameter = g.drag_diameter;
  const double harder = g.grain_friction - grains.law.static_friction;
  grains.law.static_friction += harder, grains.law.dynamic_friction += harder;
  grains.instruction_set = best_instruction_set();
  dry.internal_friction = grains.law.static_friction;
  std::vector<double> depth;
  const double borne = (1 - g.liquefied) * (1 - g.liquid_density / g.grain_density);
  for (const double z : s.sets[0].z) depth.push_back(borne * (g.grain_height - z));
  const auto stress = add_grain_stress(made.step, s, 0, grains, depth);
  if (g.dilatancy) add_dilatancy(made.step, s, stress, *g.dilatancy);
  LiquidSettings liquid;
  liquid.spacing = g.spacing, liquid.smoothing_length = h;
  liquid.reference_density = g.liquid_density;
  liquid.sound_speed = g.sound_speed;
  liquid.law.consistency = g.viscosity;
  liquid.instruction_set = best_instruction_set();
  add_liquid(made.step, s, 1, liquid, liquid_depth(g, s.sets[1]));
  CouplingSettings coupling;
  coupling.grain_density = g.grain_density, coupling.liquid_density = g.liquid_density;
  coupling.viscosity = g.viscosity, coupling.drag_diameter = g.drag_diameter;
  coupling.drag_multiplier = g.drag_multiplier;
  coupling.smoothing_length = h, coupling.spacing = g.spacing;
  coupling.buoyancy = g.buoyancy;
  if (g.coupled) add_coupling(made.step, s, 0, 1, coupling);
  add_terrain_contact(made.step, 0, dry);
  if (g.walled) {
    add_wall_contact(made.step, 0, dry);
    add_wall_contact(made.step, 1, wet);
  }
  for (const std::size_t set : {0, 1}) {
    add_motion(made.step, set, {g.spacing, h});
    refresh_motion(s, s.sets[set], 0);
    s.sets[set].ledger.kinetic_0 = s.sets[set].ledger.kinetic;
  }
  return made;
}

double excess_pressure(const State& s, const ImmersedGrains& g, double from, double to) {
  const MovingSet& p = s.sets[1];
  const auto& stress = p.components(fields::stress);
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.z[i] < from || p.z[i] >= to || p.x[i] > g.grain_length) continue;
    const double pressure = -(stress[0][i] + stress[1][i] + stress[2][i]) / 3;
    sum += pressure - g.liquid_density * standard_gravity * (g.liquid_height - p.z[i]);
    ++n;
  }
  return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace sturz::test
