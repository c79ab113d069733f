// SPDX-License-Identifier: Apache-2.0
/// Whole runs of small scenes: how they end, what they keep, and that their bits repeat.
#include "engine/simulation/simulation.hpp"

#include "engine/core/error.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "engine/effects/motion/effect.hpp"
#include "engine/simulation/parts.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/catalogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

/// About 400 particles that slide from a slope of 30 degrees onto level ground.
Scenario small_slide() {
  Scenario s = ramp_slide(90, 4);
  s.release.cylinder->radius_m = 10;
  s.numerics.end_time_s = 4;
  s.numerics.stop_at_rest = false;
  return s;
}

MemberResult run(const Scenario& s, int threads = 1, InstructionSet set = best_instruction_set()) {
  return assemble(s, load_scene_inputs(s), 3, threads, set).run();
}

TEST(Simulation, AShippedSceneIsOneSetWithNoPassOfAnother) {
  const Simulation simulation = assemble(ramp_slide(), load_scene_inputs(ramp_slide()), 0, 1);
  EXPECT_EQ(simulation.parts().state.sets.size(), 1U);
  EXPECT_EQ(simulation.parts().step.pass_names().size(), 9U)
      << "sound speed, lists, ground, gather, sweep, kick, contact, stress, motion and no more";
}

TEST(Simulation, GivesTheSameBitsAtAnyNumberOfThreads) {
  Scenario s = ramp_slide(90, 1.8);  // more than one block of the ordered sums
  s.numerics.end_time_s = 1.4;
  const MemberResult one = run(s, 1), two = run(s, 2);
  ASSERT_GT(one.scalars.n_particles, 1100);
  ASSERT_GE(one.scalars.n_steps, 300);
  EXPECT_EQ(one.state_hash, two.state_hash);
  EXPECT_EQ(one.scalars.n_steps, two.scalars.n_steps);
  EXPECT_EQ(one.scalars.energy_residual, two.scalars.energy_residual);
  for (int k = 0; k < n_peak_layers; ++k)
    EXPECT_THAT(two.layers[k], testing::Pointwise(testing::NanSensitiveFloatEq(), one.layers[k]));
}

TEST(Simulation, GivesTheSameBitsOnBothVectorWidths) {
  if (!supports(InstructionSet::avx512)) GTEST_SKIP() << "this machine has no AVX-512";
  const MemberResult narrow = run(small_slide(), 1, InstructionSet::avx2);
  const MemberResult wide = run(small_slide(), 1, InstructionSet::avx512);
  ASSERT_GE(narrow.scalars.n_steps, 300);
  EXPECT_EQ(narrow.state_hash, wide.state_hash);
  EXPECT_EQ(narrow.scalars.energy_residual, wide.scalars.energy_residual);
}

TEST(Simulation, ThePlainLoopTellsTheSameStory) {
  const MemberResult fast = run(small_slide()),
                     plain = run(small_slide(), 1, InstructionSet::plain);
  EXPECT_NEAR(plain.scalars.com_travel_m, fast.scalars.com_travel_m,
              1e-3 * fast.scalars.com_travel_m);
  EXPECT_NEAR(plain.scalars.max_mean_speed_m_s, fast.scalars.max_mean_speed_m_s,
              1e-3 * fast.scalars.max_mean_speed_m_s);
}

TEST(Simulation, MembersOfOneNumberAreEqualAndOfAnotherAreNot) {
  const Scenario s = small_slide();
  const SceneInputs in = load_scene_inputs(s);
  const auto hash = [&](int member) { return assemble(s, in, member, 1).run().state_hash; };
  const auto first = hash(1);
  EXPECT_EQ(hash(1), first);
  EXPECT_NE(hash(2), first);  // the release lattice is jittered per member
}

TEST(Simulation, KeepsItsMassExactly) {
  const Scenario s = small_slide();
  Simulation simulation = assemble(s, load_scene_inputs(s), 0, 1);
  std::vector<double> before = simulation.parts().state.grains().mass;
  const MemberResult result = simulation.run();
  std::vector<double> after = simulation.parts().state.grains().mass;
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  EXPECT_EQ(before, after);
  EXPECT_EQ(result.scalars.mass_error, 0);
  EXPECT_EQ(result.scalars.lost_mass_kg, 0);
  const double layer = result.scalars.release_volume_m3;
  EXPECT_NEAR(result.scalars.released_mass_kg, layer * 2600 * 0.6, 1e-9 * layer * 1560);
}

TEST(Simulation, PairForcesHaveNoDrift) {
  const Scenario s = small_slide();
  Simulation simulation = assemble(s, load_scene_inputs(s), 0, 1);
  simulation.run();
  const Ledger& ledger = simulation.parts().state.grains().ledger;
  for (double impulse : ledger.stress_impulse)
    EXPECT_LT(std::abs(impulse), 1e-6 * ledger.stress_impulse_scale);
}

TEST(Simulation, TellsWhatBoundItsStep) {
  const MemberResult result = run(small_slide());
  EXPECT_EQ(result.binding_limit, "acoustic");
  EXPECT_NEAR(result.scalars.mean_dt_s, 4 / result.scalars.n_steps, 1e-12);
  EXPECT_LT(result.scalars.max_mach, 0.15);
  EXPECT_LT(result.scalars.max_density_error, 0.05);
}

TEST(Simulation, EndsAtItsEndTime) {
  const MemberResult result = run(small_slide());
  EXPECT_EQ(result.outcome, Outcome::out_of_time);
  EXPECT_NEAR(result.scalars.end_time_s, 4, 1e-12);
  EXPECT_EQ(result.member, 3);
}

TEST(Simulation, AMassThatCannotMoveSettlesWithoutRunout) {
  Scenario s = block_on_plane(0.9);
  s.terrain.synthetic->parameters["slope_deg"] = 15;
  s.numerics.spacing_m = 2;
  s.numerics.end_time_s = 60;
  const MemberResult result = run(s);
  EXPECT_EQ(result.outcome, Outcome::settled);
  EXPECT_EQ(result.reason, "");
  EXPECT_LT(result.scalars.end_time_s, 30);
  EXPECT_LT(result.scalars.com_travel_m, 1);
}

TEST(Simulation, CanBeCancelled) {
  const Scenario s = small_slide();
  RunControl control;
  control.progress_every_s = 0;
  std::vector<Progress> seen;
  control.on_progress = [&](const Progress& p) {
    seen.push_back(p);
    return seen.size() < 3;
  };
  const MemberResult result = assemble(s, load_scene_inputs(s), 0, 1).run(control);
  EXPECT_EQ(result.outcome, Outcome::cancelled);
  EXPECT_THAT(result.reason, testing::StartsWith("cancelled at t = "));
  EXPECT_EQ(result.scalars.n_steps, 48);  // sampled every 16 steps
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_LT(seen[0].time_s, seen[1].time_s);
  EXPECT_EQ(seen[0].end_time_s, 4);
  EXPECT_GT(seen[2].kinetic_energy_j, 0);
  EXPECT_EQ(seen[2].n_particles, result.scalars.n_particles);
}

TEST(Simulation, FailsWithAReasonAtItsWallLimit) {
  const Scenario s = small_slide();
  RunControl control;
  control.max_wall_s = 1e-9;
  const MemberResult result = assemble(s, load_scene_inputs(s), 0, 1).run(control);
  EXPECT_EQ(result.outcome, Outcome::failed);
  EXPECT_THAT(result.reason, testing::HasSubstr("wall-time limit"));
  EXPECT_EQ(result.scalars.n_steps, 16);
}

TEST(Simulation, NotANumberIsAnOutcome) {
  const Scenario s = small_slide();
  const SceneInputs in = load_scene_inputs(s);
  for (double poison : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (auto column : {&ParticleSet::vx, &ParticleSet::vy, &ParticleSet::vz, &ParticleSet::z}) {
      Simulation simulation = assemble(s, in, 0, 1);
      simulation.step();
      (simulation.parts().state.grains().*column)[7] = poison;
      const MemberResult result = simulation.run();
      EXPECT_EQ(result.outcome, Outcome::diverged);
      EXPECT_THAT(result.reason, testing::HasSubstr("not finite"));
      EXPECT_LE(result.scalars.n_steps, 3);
    }
}

TEST(Simulation, ARunawayParticleIsAnOutcome) {
  const Scenario s = small_slide();
  Simulation simulation = assemble(s, load_scene_inputs(s), 0, 1);
  for (int n = 0; n < 5; ++n) simulation.step();
  ParticleSet& p = simulation.parts().state.grains();
  p.vy[3] = 1e7;
  refresh_motion(simulation.parts().state, simulation.parts().state.grains(), 0);
  const MemberResult result = simulation.run();
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_THAT(result.reason, testing::HasSubstr("time step collapsed"));
}

TEST(Simulation, AllMassMayLeaveTheTerrain) {
  Scenario s = block_on_plane(0.1);
  s.terrain.synthetic->parameters["length_m"] = 60;
  s.release.box = ReleaseBox{{20, 26}, {-3, 3}};
  s.numerics.spacing_m = 2;
  s.numerics.end_time_s = 30;
  const MemberResult result = run(s);
  EXPECT_EQ(result.outcome, Outcome::left_terrain);
  EXPECT_THAT(result.reason, testing::HasSubstr("mass left the terrain"));
  EXPECT_NEAR(result.scalars.lost_mass_kg, result.scalars.released_mass_kg,
              1e-12 * result.scalars.released_mass_kg);
  EXPECT_LT(std::abs(result.scalars.mass_error), 1e-14);
  EXPECT_LT(result.scalars.end_time_s, 10);
  EXPECT_GT(result.scalars.max_thickness_m, 1);
}

TEST(Simulation, SomeMassMayLeaveTheTerrain) {
  Scenario s = block_on_plane(0.3);
  s.release.box = ReleaseBox{{62, 78}, {-3, 3}};
  s.numerics.spacing_m = 2;
  s.numerics.end_time_s = 2;
  const MemberResult result = run(s);
  EXPECT_EQ(result.outcome, Outcome::left_terrain);
  EXPECT_THAT(result.reason, testing::ContainsRegex("^[0-9]+ % of the mass left the terrain"));
  EXPECT_GT(result.scalars.lost_mass_kg, 0.01 * result.scalars.released_mass_kg);
  EXPECT_LT(result.scalars.lost_mass_kg, result.scalars.released_mass_kg);
  EXPECT_LT(std::abs(result.scalars.mass_error), 1e-14);
}

TEST(Simulation, FramesComeAtTheirTimes) {
  const Scenario s = small_slide();
  RunControl control;
  control.frame_every_s = 1;
  std::vector<double> times;
  std::size_t n = 0;
  control.on_frame = [&](const ParticleFrame& f) {
    times.push_back(f.time_s);
    n = f.x.size();
    EXPECT_EQ(f.density.size(), n);
    EXPECT_EQ(f.id.size(), n);
  };
  assemble(s, load_scene_inputs(s), 0, 1).run(control);
  ASSERT_GE(times.size(), 5u);
  EXPECT_EQ(times.front(), 0);
  EXPECT_NEAR(times[1], 1, 0.02);
  EXPECT_NEAR(times[3], 3, 0.02);
  EXPECT_NEAR(times.back(), 4, 1e-12);
  EXPECT_GT(n, 0u);
}

TEST(Simulation, FramesOfEveryStepDoNotHang) {
  Scenario s = small_slide();
  s.numerics.end_time_s = 0.05;
  RunControl control;
  control.frame_every_s = 0;
  int frames = 0;
  control.on_frame = [&](const ParticleFrame&) { ++frames; };
  const MemberResult result = assemble(s, load_scene_inputs(s), 0, 1).run(control);
  EXPECT_GE(frames, result.scalars.n_steps);
}

TEST(Simulation, AShortPeriodIsRefused) {
  Scenario s = thin_sheet(1);
  s.numerics.spacing_m = 3;
  const SceneInputs in = load_scene_inputs(s);
  try {
    assemble(s, in, 0, 1);
    FAIL() << "accepted a period of 8 m at a spacing of 3 m";
  } catch (const SetupError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("domain.periodic = y"));
  }
}

TEST(Simulation, TravelCountsWholePeriods) {
  Scenario s = thin_sheet(2);  // 12 m of slope that repeats
  s.grains->friction.reset();
  s.grains->friction_angle_deg = Uncertain(40);
  s.basal.friction_coefficient = 0.2;
  s.numerics.end_time_s = 3;
  Simulation simulation = assemble(s, load_scene_inputs(s), 0, 1);
  RunControl control;
  control.progress_every_s = 0;
  control.on_progress = [&](const Progress&) {
    return simulation.parts().state.grains().order_changed =
               true;  // lists anew: particles are wrapped
  };
  const MemberResult result = simulation.run(control);
  const double slope = 30 * std::acos(-1.0) / 180;
  const double down = 9.81 * (std::sin(slope) - 0.2 * std::cos(slope));
  const double along = 0.5 * down * 9 * std::cos(slope);  // 14.4 m on the map
  EXPECT_NEAR(result.scalars.com_travel_m, along, 0.02 * along);
  EXPECT_NEAR(result.scalars.front_travel_m, along, 0.05 * along);
}

}  // namespace
}  // namespace sturz
