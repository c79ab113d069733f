// SPDX-License-Identifier: Apache-2.0
// V3, saturated: grains at rest in their own depth of water bear their submerged weight, the water
// its own.
#include "tests/physics/coupled/coupled_books.hpp"

#include <fmt/core.h>

namespace sturz::test {
namespace {

/// 1 m deep, periodic along x and y.
ImmersedGrains basin(int layers) {
  ImmersedGrains g;
  g.spacing = 1.0 / layers;
  g.grain_length = g.liquid_length = 6 * g.spacing;
  g.sound_speed = 10 * std::sqrt(g.gravity * g.grain_height);
  return g;
}

struct Profile {
  double off = 0, all = 0;          ///< sums of squares
  double lowest = 0, lowest_n = 0;  ///< of the lowest layer: sum of found / expected

  void add(double found, double expected, bool is_lowest) {
    off += (found - expected) * (found - expected);
    all += expected * expected;
    if (is_lowest) lowest += found / expected, ++lowest_n;
  }
  double l2() const { return std::sqrt(off / all); }
  double lowest_error() const { return lowest / lowest_n - 1; }
};

/// Pressure of the water against rho_f g depth.
Profile pore_pressure(const State& s, const ImmersedGrains& g) {
  const MovingSet& p = s.sets[1];
  Profile out;
  for (std::size_t i = 0; i < p.size(); ++i)
    out.add(pressure_of(p, i), g.liquid_density * g.gravity * (g.liquid_height - p.z[i]),
            p.z[i] < g.spacing);
  return out;
}

/// Vertical effective stress against alpha (rho_p - rho_f) g depth.
Profile effective_stress(const State& s, const ImmersedGrains& g) {
  const MovingSet& p = s.sets[0];
  const auto& t = p.components(fields::stress);
  const double weight = g.solid_fraction * (g.grain_density - g.liquid_density) * g.gravity;
  Profile out;
  for (std::size_t i = 0; i < p.size(); ++i)
    out.add(-t[2][i], weight * (g.grain_height - p.z[i]), p.z[i] < g.spacing);
  return out;
}

double mean_height(const ParticleSet& p) {
  double z = 0;
  for (const double zi : p.z) z += zi / static_cast<double>(p.size());
  return z;
}

TEST(SaturatedColumn, CarriesItsWeightInTwoParts) {
  for (const int layers : {5, 10, 20}) {
    const ImmersedGrains g = basin(layers);
    HandMade made = immersed(g);
    State& s = made.state;
    const double start[] = {mean_height(s.sets[0]), mean_height(s.sets[1])};
    advance_to(made, 5 * std::sqrt(g.grain_height / g.gravity));
    const std::string name = fmt::format("V3 saturated, layers {}", layers);
    const Profile water = pore_pressure(s, g), grains = effective_stress(s, g);
    expect_within({name + ", pore pressure", "L2 of the profile", water.l2(), 0, water.l2(), 0.02});
    expect_within(
        {name + ", effective stress", "L2 of the profile", grains.l2(), 0, grains.l2(), 0.02});
    record({name + ", lowest layer, pore pressure", "off", water.lowest_error(), 0,
            water.lowest_error()});
    record({name + ", lowest layer, effective stress", "off", grains.lowest_error(), 0,
            grains.lowest_error()});
    const Ledger both = s.ledger();
    const double kinetic = both.kinetic / (both.released_mass * g.gravity * g.grain_height);
    expect_within({name + ", kinetic energy", "/ m g H", kinetic, 0, kinetic, 1e-5});
    for (const std::size_t set : {0u, 1u}) {
      const double shift = mean_height(s.sets[set]) - start[set];
      expect_within({fmt::format("{}, shift of set {}", name, set), "/ H", shift, 0, shift, 0.005});
    }
    expect_coupled_books(name, s);
  }
}

}  // namespace
}  // namespace sturz::test
