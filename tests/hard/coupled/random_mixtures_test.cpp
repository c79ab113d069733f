// SPDX-License-Identifier: Apache-2.0
// Grains in liquids from the corners of a debris flow's prior. STURZ_HARD_MEMBERS=300 runs as many
// (docs/studies/stability_liquid.md).
#include "tests/hard/coupled/random_mixtures.hpp"

#include "tests/hard/expect_holds.hpp"
#include "tests/hard/steep_ground.hpp"

namespace sturz::test {
namespace {

TEST(RandomMixtures, Survive) {
  for (int number = 0; number < hard_members(10); ++number) {
    const HardMixture m = hard_mixture(static_cast<std::uint64_t>(number));
    const MixtureSurvival s = run(m);
    const ImmersedGrains& g = m.scene;
    fmt::print(
        "{}: {} solids {:.2f}, densities {:.0f} in {:.0f}, mu {:.1e}, d {:.1e}, drag x {:.0f}, dx "
        "{:.2f}, {:.0f} particles, {:.0f} steps, {:.1f} s, residual {:.1e}, numerical {:.3f}, "
        "speed {:.2f}, least step {:.2f}\n",
        m.name, s.stopped, g.solid_fraction, g.grain_density, g.liquid_density, g.viscosity,
        g.drag_diameter, g.drag_multiplier, g.spacing, s.particles, s.steps, s.seconds,
        s.energy_residual, s.numerical_share, s.speed_ratio, s.least_dt_ratio);
    expect_holds(m.name, checks_of(s));
  }
}

}  // namespace
}  // namespace sturz::test
