// SPDX-License-Identifier: Apache-2.0
#include "tests/hard/coupled/random_mixtures.hpp"

#include "engine/core/constants.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/motion/accounts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <utility>

namespace sturz::test {
namespace {

/// The same numbers on every machine.
class Draw {
 public:
  explicit Draw(std::uint64_t number) : random_(1013 * number + 7) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  double decades(double low, double high) {
    return std::pow(10, between(std::log10(low), std::log10(high)));
  }
  int whole(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool one_of(int n) { return whole(1, n) == 1; }

 private:
  std::mt19937_64 random_;
};

void draw_materials(ImmersedGrains& g, Draw& draw) {
  g.spacing = draw.decades(0.05, 1);
  g.solid_fraction = draw.between(0.3, 0.7);
  g.liquid_density = draw.between(1000, 1150);
  g.grain_density =
      draw.one_of(4) ? draw.between(1.04, 1.2) * g.liquid_density : draw.between(2400, 2900);
  g.viscosity = draw.decades(1e-3, 0.1);
  g.drag_diameter = draw.one_of(8) ? 1e-4 : draw.decades(3e-5, 3e-2);
  g.drag_multiplier = draw.one_of(4) ? 100 : 1;
  g.friction = draw.between(0.1, 1);
  g.grain_friction = draw.between(0.3, 0.8);
  if (draw.one_of(3)) g.liquefied = draw.between(0, 1);
}

/// Both boxes the same.
void draw_mass(ImmersedGrains& g, Draw& draw, int least_layers, int most_layers) {
  g.grain_height = g.liquid_height = draw.whole(least_layers, most_layers) * g.spacing;
  g.grain_length = g.liquid_length = draw.whole(4, 10) * g.spacing;
  g.walled = true;
}

void add_loosening(ImmersedGrains& g, Draw& draw) {
  DilatancySettings d;
  d.law.solid_density = g.grain_density;
  d.law.fluid_viscosity = g.viscosity;
  d.law.critical_fraction = draw.between(0.5, 0.64);
  d.law.grain_diameter = g.drag_diameter;
  d.reference_fraction = g.solid_fraction;
  d.slope = draw.between(1, 4);
  g.dilatancy = d;
}

const char* draw_scene(HardMixture& m, Draw& draw, std::uint64_t kind) {
  ImmersedGrains& g = m.scene;
  draw_mass(g, draw, kind == 6 ? 1 : 2, kind == 6 ? 1 : 7);
  m.wall_x = g.liquid_length + g.reach;
  m.saturation = kind == 2 ? 0.6 : kind == 3 ? 0.05 : 1;
  switch (kind) {
    case 1:
      g.liquid_length = 0.5 * std::round(g.grain_length / g.spacing) * g.spacing;
      m.speed = -draw.between(2, 20), m.from_x = g.liquid_length, m.to_x = 1e300;
      return "dry front into a wet mass";
    case 2:
    case 3:
      return kind == 2 ? "pores 0.6 full" : "pores 0.05 full";
    case 4:
      m.speed = draw.between(5, 20), m.to_x = 1e300;
      m.wall_x = g.liquid_length + 3 * g.spacing;
      return "wet mass against a wall";
    case 5:
      g.liquid_length = 2 * g.grain_length;
      m.speed = draw.between(5, 20), m.to_x = g.grain_length;
      return "wet mass into water";
    case 6:
      m.speed = draw.between(0, 10), m.to_x = 1e300;
      return "one layer";
    case 7:
      g.liquid_length = 2 * g.grain_length;
      m.wall_x = g.liquid_length;
      add_loosening(g, draw);
      return "under water, dilatant";
    default:
      return "wet collapse";
  }
}

void drain(MovingSet& water, double from_x, double saturation) {
  auto& change = water.scalar(fields::density_change);
  for (std::size_t i = 0; i < water.size(); ++i) {
    if (water.x[i] < from_x) continue;
    water.ledger.released_mass -= (1 - saturation) * water.mass[i];
    change[i] = saturation - 1;
    for (auto& t : water.components(fields::stress)) t[i] = 0;
    water.mass[i] *= saturation;
  }
}

HandMade scene_of(const HardMixture& m) {
  HandMade made = immersed(m.scene);
  State& s = made.state;
  s.domain.walls[1].point.x() = m.wall_x;
  if (m.saturation < 1) drain(s.sets[1], 0.5 * m.scene.grain_length, m.saturation);
  for (MovingSet& p : s.sets) {
    auto& before = p.components(fields::velocity_before);
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.x[i] > m.from_x && p.x[i] < m.to_x) p.vx[i] = before[0][i] = m.speed;
    refresh_motion(s, p, 0);
    p.ledger.kinetic_0 = p.ledger.kinetic;
  }
  return made;
}

double mass_error(const MovingSet& p) {
  double mass = 0;
  for (const double m : p.mass) mass += m;
  return std::abs(mass + p.ledger.lost_mass - p.ledger.released_mass) / p.ledger.released_mass;
}

bool all_finite(const ParticleSet& p) {
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!std::isfinite(p.x[i] + p.y[i] + p.z[i] + p.vx[i] + p.vy[i] + p.vz[i])) return false;
  return true;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

HardMixture hard_mixture(std::uint64_t number) {
  Draw draw(number);
  HardMixture m;
  ImmersedGrains& g = m.scene;
  draw_materials(g, draw);
  g.reach = 60 * g.spacing;
  const char* kind = draw_scene(m, draw, number % 8);
  const double height = g.liquid_height, fall = std::sqrt(g.gravity * height);
  g.sound_speed = 10 * std::max(std::abs(m.speed), fall);
  m.end_s = 3 * std::sqrt(2 * height / g.gravity) + 6 * g.spacing / std::max(1.0, m.speed);
  m.name = fmt::format("mixture, member {}, {}", number, kind);
  return m;
}

MixtureSurvival run(const HardMixture& m) {
  const auto begin = std::chrono::steady_clock::now();
  HandMade made = scene_of(m);
  State& s = made.state;
  MixtureSurvival out;
  double fastest = 0, released = 0, least_step = 1e300, first_step = 0;
  const double top = m.scene.liquid_height;
  out.finite = true;
  while (s.time < m.end_s && out.stopped.empty()) {
    const double dt = made.advance();
    if (s.n_steps == 2) first_step = dt;
    if (s.n_steps > 2) least_step = std::min(least_step, dt);
    for (const MovingSet& p : s.sets) fastest = std::max(fastest, p.motion.max_speed);
    if (s.n_steps % 16 == 0)
      for (const MovingSet& p : s.sets) out.finite = out.finite && all_finite(p);
    released = std::max(released, s.ledger().released_energy());
    if (!out.finite) out.stopped = "not a number";
    if (!(dt > 1e-3 * first_step)) out.stopped = "step of 1e-3 of the first";
    if (seconds_since(begin) > 60) out.stopped = "60 s";
  }
  for (const MovingSet& p : s.sets) {
    out.finite = out.finite && all_finite(p);
    out.mass_error = std::max(out.mass_error, mass_error(p));
    out.leaked_share = std::max(out.leaked_share, p.ledger.leaked_mass / p.ledger.released_mass);
    out.particles += static_cast<double>(p.size());
  }
  const Ledger both = s.ledger();
  const double gravity = m.scene.gravity;
  const double fall = std::sqrt(m.speed * m.speed + 2 * gravity * top);
  out.speed_ratio = fastest / (fall + 2 * std::sqrt(gravity * top));
  out.energy_residual = std::abs(both.residual()) / released;
  out.numerical_share = both.numerical() / released;
  out.steps = static_cast<double>(s.n_steps);
  out.least_dt_ratio = least_step / first_step;
  out.seconds = seconds_since(begin);
  return out;
}

std::vector<Check> checks_of(const MixtureSurvival& s) {
  return {at_most("members stopped early", s.stopped.empty() ? 0 : 1, 0),
          at_most("members with NaN", s.finite ? 0 : 1, 0),
          at_most("mass error", s.mass_error, 1e-12),
          at_most("leaked share of the mass", s.leaked_share, 0),
          at_most("largest speed / (free fall + 2 sqrt(g H))", s.speed_ratio, 1.05),
          at_most("energy residual", s.energy_residual, 0.01),
          at_least("least step / first", s.least_dt_ratio, 0.05)};
}

}  // namespace sturz::test
