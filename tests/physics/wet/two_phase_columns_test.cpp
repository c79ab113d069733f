// SPDX-License-Identifier: Apache-2.0
// Grains and liquid at two velocities: locked they are a flow of one phase (T7), free the liquid
// runs ahead; masses and energy, slopes, the same bits at any number of threads.
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

namespace sturz::test {
namespace {

/// What is mixed: friction of the grains, their share, densities [kg/m3].
struct Mixed {
  std::string name;
  double friction, solids, grain_density, liquid_density;

  double density() const { return solids * grain_density + (1 - solids) * liquid_density; }
  /// mu a_s (rho_s - rho_f)/rho: of both together where nothing slips.
  double effective_friction() const {
    return friction * solids * (grain_density - liquid_density) / density();
  }
};
void PrintTo(const Mixed& m, std::ostream* out) { *out << m.name; }
const Mixed mixtures[] = {{"Landslide", 0.5, 0.5, 2800, 1200}, {"Flume", 0.8, 0.417, 2600, 1570}};

Scenario two_phases(const Mixed& of, double permeability, double spacing) {
  Scenario s = similarity_slide(spacing);
  s.grains->density_kg_m3 = of.grain_density;
  s.grains->solid_fraction = of.solids;
  MixtureSpec& wet = s.mixture.emplace();
  wet.phases = MixturePhases::two;
  wet.fluid_density_kg_m3 = of.liquid_density;
  wet.fluid_viscosity_pa_s = 1e-5;  // without drag at the bed
  wet.permeability_m2 = permeability;
  s.basal.friction_coefficient = of.friction;
  return s;
}

/// Centre of mass, its speed and the standard deviation along the slope of all sets together.
struct Whole {
  double x = 0, vx = 0, spread = 0;
};
Whole whole(const State& s) {
  Whole w;
  double mass = 0, xx = 0;
  for (const MovingSet& p : s.sets)
    for (std::size_t i = 0; i < p.size(); ++i) {
      mass += p.mass[i];
      w.x += p.mass[i] * p.x[i], w.vx += p.mass[i] * p.vx[i];
      xx += p.mass[i] * p.x[i] * p.x[i];
    }
  w.x /= mass, w.vx /= mass;
  w.spread = std::sqrt(xx / mass - w.x * w.x);
  return w;
}

class Locked : public testing::TestWithParam<Mixed> {};
INSTANTIATE_TEST_SUITE_P(Mixtures, Locked, testing::ValuesIn(mixtures),
                         [](const auto& i) { return i.param.name; });

TEST_P(Locked, AreAFlowOfOnePhase) {  // T7
  const Mixed& of = GetParam();
  for (const double spacing : {8.0, 4.0}) {
    Scenario one = similarity_slide(spacing);
    one.grains->density_kg_m3 = of.density() / of.solids;
    one.grains->solid_fraction = of.solids;
    one.basal.friction_coefficient = of.effective_friction();
    const Finished single = run(build(one));
    const Finished locked = run(build(two_phases(of, 1e-14, spacing)));
    expect_conserved(locked);
    const Whole a = whole(single.simulation.parts().state),
                b = whole(locked.simulation.parts().state);
    const double travel = a.x + 120;
    fmt::print(
        "T7 {}, mu_eff {:.3f}, dx {} m: travel {:.3f} and {:.3f} m ({:+.3f} %), speed "
        "{:+.3f} %, spread {:+.3f} %, fronts {:.2f} | {:.2f} {:.2f} m\n",
        of.name, of.effective_friction(), spacing, travel, b.x + 120, 100 * (b.x - a.x) / travel,
        100 * (b.vx / a.vx - 1), 100 * (b.spread / a.spread - 1),
        single.result.scalars.front_travel_m, locked.result.scalars.solid_front_travel_m,
        locked.result.scalars.liquid_front_travel_m);
    EXPECT_NEAR(b.x - a.x, 0, 0.005 * travel);
    EXPECT_NEAR(b.vx / a.vx, 1, 0.005);
    EXPECT_NEAR(b.spread / a.spread, 1, 0.005);
  }
}

TEST(TwoPhaseColumns, HaveTheFrictionOfThePublishedCases) {
  EXPECT_NEAR(mixtures[0].effective_friction(), 0.200, 5e-4);
  EXPECT_NEAR(mixtures[1].effective_friction(), 0.172, 5e-4);
}

/// Down 31 degrees and out on level ground, with little and with much drag.
TEST(TwoPhaseColumns, LiquidRunsAheadTheMoreTheLessItIsHeld) {
  double lead[3], k = 0;
  for (const double speed : {0.01, 1.0, 30.0}) {
    Scenario s = wet_ramp(0.6);
    MixtureSpec& wet = *s.mixture;
    wet.phases = MixturePhases::two;
    wet.drag_law = PhaseDragLaw::settling;
    wet.settling_speed_m_s = Uncertain(speed);
    s.basal.turbulent_coefficient_m_s2 = Uncertain(500);
    s.numerics.end_time_s = 25;
    const Finished f = run(build(s));
    expect_conserved(f);
    const MemberScalars& m = f.result.scalars;
    EXPECT_LE(std::abs(m.solids_error), 1e-13);
    EXPECT_LE(std::abs(m.water_error), 1e-13);
    EXPECT_GT(m.drag_loss_fraction, 0);
    const State& state = f.simulation.parts().state;
    lead[static_cast<int>(k++)] = mean_motion(state.sets[1]).x - mean_motion(state.sets[0]).x;
    fmt::print(
        "settling {} m/s: runout grains {:.0f} m, liquid {:.0f} m; centres {:.1f} m apart; "
        "drag took {:.1f} %, raised in {:.1f} %, residual {:.2g} %\n",
        speed, m.solid_runout_m, m.liquid_runout_m, lead[static_cast<int>(k) - 1],
        100 * m.drag_loss_fraction, 100 * m.drag_raised_fraction, 100 * m.energy_residual);
  }
  EXPECT_LT(std::abs(lead[0]), 3);
  EXPECT_GT(lead[1], lead[0]);
  EXPECT_GT(lead[2], lead[1]);
  EXPECT_GT(lead[2], 20);
}

TEST(TwoPhaseColumns, GiveTheSameBitsAtAnyNumberOfThreads) {
  Scenario s = wet_ramp(0.6, 0.85);
  s.mixture->phases = MixturePhases::two;
  s.mixture->permeability_m2 = Uncertain(1e-7);
  s.numerics.end_time_s = 1;
  const Finished one = run(build(s, 1)), two = run(build(s, 2));
  ASSERT_GT(one.result.scalars.n_particles, 2 * 1100) << "more than one block of the ordered sums";
  EXPECT_EQ(one.result.state_hash, two.result.state_hash);
  EXPECT_EQ(one.result.scalars.drag_loss_fraction, two.result.scalars.drag_loss_fraction);
  EXPECT_EQ(one.result.layer(PeakLayer::solid), two.result.layer(PeakLayer::solid));
  EXPECT_EQ(one.result.layer(PeakLayer::liquid), two.result.layer(PeakLayer::liquid));
}

/// The map of both is at least that of each, and at the release their sum.
TEST(TwoPhaseColumns, MapsTellTheThicknessOfEach) {
  Scenario s = wet_ramp(0.6);
  s.mixture->phases = MixturePhases::two;
  s.numerics.end_time_s = 10;
  const MemberResult r = run(build(s)).result;
  const auto &all = r.layer(PeakLayer::thickness), &solid = r.layer(PeakLayer::solid),
             &liquid = r.layer(PeakLayer::liquid);
  ASSERT_EQ(solid.size(), all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    ASSERT_LE(solid[k], all[k] * 1.0001F);
    ASSERT_LE(liquid[k], all[k] * 1.0001F);
    ASSERT_GE(solid[k] + liquid[k], all[k] * 0.85F);  // tops between instants are the sum's alone
  }
  EXPECT_NEAR(r.scalars.max_solid_thickness_m / r.scalars.max_liquid_thickness_m, 1.5, 0.1);
  Scenario one = wet_ramp(0.6);
  one.numerics.end_time_s = 1;
  const MemberResult plain = run(build(one)).result;
  EXPECT_TRUE(plain.layer(PeakLayer::solid).empty());
  EXPECT_TRUE(std::isnan(plain.scalars.solid_runout_m));
}

}  // namespace
}  // namespace sturz::test
