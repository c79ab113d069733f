// SPDX-License-Identifier: Apache-2.0
// V17: a column whose pore water bears all of the grains' weight at first drains at its surface.
#include "tests/physics/coupled/coupled_books.hpp"

#include <fmt/core.h>

#include <numbers>

namespace sturz::test {
namespace {

/// Terzaghi (1925) for a load that grows with depth, its own weight, drained at the top alone:
/// p/p_0 = sum 2/M^2 cos(M z/H) exp(-M^2 T_v), M = (2n + 1) pi/2, p_0 that at the bottom.
double excess(double z, double time_factor) {
  double sum = 0;
  for (int n = 0; n < 60; ++n) {
    const double m = (2 * n + 1) * std::numbers::pi / 2;
    sum += 2 / (m * m) * std::cos(m * z) * std::exp(-m * m * time_factor);
  }
  return sum;
}

/// 1 m of elastic grains (c_v is that of K + 4G/3; yielding ones give way by another modulus).
ImmersedGrains soft_ground(int layers) {
  ImmersedGrains g;
  g.spacing = 1.0 / layers;
  g.grain_length = g.liquid_length = 6 * g.spacing;
  g.drag_diameter = 5.5e-4;
  g.grain_friction = 10;
  g.liquefied = 1;
  return g;
}

/// k/(mu (1/M + alpha_f/K_f)), the water being soft, too; k of Ergun's law without inertia [m^2/s].
double consolidation(const ImmersedGrains& g) {
  const double solids = g.solid_fraction, pores = 1 - solids;
  const double k = std::pow(pores, 3) * g.drag_diameter * g.drag_diameter / (150 * solids * solids);
  const double skeleton = solids * g.grain_density * g.sound_speed * g.sound_speed;
  const double water = g.liquid_density * g.sound_speed * g.sound_speed;
  return k / g.viscosity / (1 / skeleton + pores / water);
}

TEST(Consolidation, FollowsTerzaghi) {
  for (const int layers : {5, 8, 12}) {
    const ImmersedGrains g = soft_ground(layers);
    HandMade made = immersed(g);
    const double p0 = g.solid_fraction * (g.grain_density - g.liquid_density) * g.gravity;
    const std::string name = fmt::format("V17 consolidation, layers {}", layers);
    for (const double time_factor : {0.1, 0.25, 0.5}) {
      advance_to(made, time_factor / consolidation(g));
      double off = 0, all = 0;
      for (int layer = 0; layer < layers; ++layer) {
        const double from = layer * g.spacing;
        const double expected = excess(from + 0.5 * g.spacing, time_factor);
        const double found = excess_pressure(made.state, g, from, from + g.spacing) / p0;
        off += (found - expected) * (found - expected), all += expected * expected;
      }
      const double l2 = std::sqrt(off / all);
      expect_within({fmt::format("{}, T_v {}", name, time_factor), "L2 of the excess pressure", l2,
                     0, l2, 0.05});
    }
    expect_coupled_books(name, made.state);
  }
}

}  // namespace
}  // namespace sturz::test
