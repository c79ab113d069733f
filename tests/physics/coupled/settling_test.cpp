// SPDX-License-Identifier: Apache-2.0
// V15: a suspension settles in a closed column, and the liquid gives way upward.
#include "engine/laws/drag.hpp"
#include "tests/physics/coupled/coupled_books.hpp"

#include <fmt/core.h>

namespace sturz::test {
namespace {

/// Glass of 0.2 mm in 60 mm of water. The sound of the grains is slow: what the bottom holds up is
/// not to be felt in the middle.
ImmersedGrains suspension(double solids, int layers) {
  ImmersedGrains g;
  g.spacing = 0.06 / layers;
  g.grain_length = g.liquid_length = 6 * g.spacing;
  g.grain_height = 0.06 - 2 * g.spacing, g.liquid_height = 0.06;
  g.solid_fraction = solids;
  g.grain_density = 2500;
  g.drag_diameter = 2e-4;
  g.sound_speed = 10 * std::sqrt(g.gravity * g.liquid_height);
  g.grain_sound_speed = 0.1;
  g.liquefied = 1;
  return g;
}

/// beta(u) u = alpha_p alpha_f (rho_p - rho_f) g: the law's own slip [m/s].
double slip_of(const ImmersedGrains& g) {
  const GranularDrag law{g.drag_diameter, g.liquid_density, g.viscosity};
  const double solids = g.solid_fraction;
  const double weight = solids * (1 - solids) * (g.grain_density - g.liquid_density) * g.gravity;
  double slip = 0.01;
  for (int n = 0; n < 200; ++n) slip = 0.5 * (slip + weight / law.exchange(solids, slip));
  return slip;
}

double mean_rise(const ParticleSet& p, double from, double to) {
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.z[i] > from && p.z[i] < to) sum += p.vz[i], ++n;
  return sum / n;
}

TEST(HinderedSettling, IsAsFastAsTheLawSays) {
  for (const double solids : {0.1, 0.3, 0.5})
    for (const int layers : {8, 12, 16}) {
      const ImmersedGrains g = suspension(solids, layers);
      HandMade made = immersed(g);
      double down = 0, slip = 0, n = 0;
      while (made.state.time < 0.15) {
        made.advance();
        if (made.state.time < 0.05) continue;
        const double grains = mean_rise(made.state.sets[0], 0.02, 0.04);
        const double liquid = mean_rise(made.state.sets[1], 0.02, 0.04);
        down -= grains, slip += liquid - grains, ++n;
      }
      const double expected = slip_of(g);
      const std::string name = fmt::format("V15 settling, solids {}, layers {}", solids, layers);
      expect_within(relative(name + ", speed", "m/s", down / n, (1 - solids) * expected, 0.02));
      expect_within(relative(name + ", slip", "m/s", slip / n, expected, 0.02));
      expect_coupled_books(name, made.state);
    }
}

}  // namespace
}  // namespace sturz::test
