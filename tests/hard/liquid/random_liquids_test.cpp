// SPDX-License-Identifier: Apache-2.0
// Liquids from the corners of what a scene may ask for. STURZ_HARD_MEMBERS=600 runs as many.
#include "tests/hard/liquid/random_liquids.hpp"

#include "tests/hard/expect_holds.hpp"
#include "tests/hard/steep_ground.hpp"

namespace sturz::test {
namespace {

TEST(RandomLiquids, Survive) {
  for (int number = 0; number < hard_members(100); ++number) {
    const HardLiquid m = hard_liquid(static_cast<std::uint64_t>(number));
    const Survival s = run(m);
    const HerschelBulkley& law = m.box.settings.law;
    fmt::print(
        "{}: {} {}, K {:.2g}, tau_y {:.2g}, n {:.2f}, dx {:.2f}, {:.0f} particles, {:.0f} steps, "
        "{:.2f} s, residual {:.1e}, created {:.4f}, numerical {:.3f}, lowest {:.2f} dx, speed "
        "{:.2f}, step {:.2f}\n",
        m.name, to_string(s.outcome), s.reason, law.consistency, law.yield_stress, law.index,
        m.box.spacing, s.particles, s.steps, s.seconds, s.energy_residual, s.created_energy,
        s.numerical_share, s.lowest_dx, s.speed_ratio, s.mean_dt_ratio);
    expect_holds(m.name, checks_of(m, s));
  }
}

}  // namespace
}  // namespace sturz::test
