// SPDX-License-Identifier: Apache-2.0
// Depth-averaged flow on curved ground: V2, V21, a frictionless bowl and the
// same bits on any number of threads.
#include "scenarios/catalogue.hpp"
#include "tests/physics/descent.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace sturz::test {
namespace {

Scenario columns(Scenario s) {
  s.formulation = Formulation::depth_averaged;
  return s;
}

/// The single column follows the mass point; the bend presses it on (a regression test too: every
/// normal impulse counts for friction).
TEST(ColumnEnergyLine, MassEndsWhereAMassPointEnds) {
  std::vector<double> error;
  for (const double spacing : {8.0, 4.0, 2.0, 1.0}) {
    const Descent d = descend(columns(ramp_slide(90, spacing)));
    const EnergyLine line(d.s0, true), straight(d.s0, false);
    const std::string name = fmt::format("V2 columns, dx = {:.0f} m", spacing);
    error.push_back(d.rmse(line));
    expect_within({name + ", angle", "deg", d.angle_deg(), line.angle_deg(),
                   d.angle_deg() - line.angle_deg(), 0.5},
                  d.finished);
    expect_within({name + ", energy height", "rms m", drop_m * d.rmse(line), 0, d.rmse(line), 0.02},
                  d.finished);
    record({name + ", angle against the straight line", "deg", d.angle_deg(), straight.angle_deg(),
            d.angle_deg() - straight.angle_deg()},
           d.finished);
    expect_conserved(d.finished);
    if (spacing > 1) continue;
    // Of first order the error halves with the spacing; of order 0.4 it falls to three quarters.
    double worst = 0;
    for (std::size_t i = 1; i < error.size(); ++i) worst = std::max(worst, error[i] / error[i - 1]);
    expect_within({"V2 columns, energy height, convergence", "largest error / that at twice dx",
                   worst, 0.5, worst, 0.75},
                  d.finished);
  }
}

TEST(ColumnRotation, RunOutDoesNotKnowTheGrid) {
  double travel = 0, front = 0;
  for (const double azimuth : {90.0, 60.0, 45.0}) {
    const Descent d = descend(columns(ramp_slide(azimuth, 3)), azimuth);
    const double mean = d.s.back() - d.s0, farthest = d.finished.result.scalars.front_travel_m;
    if (azimuth == 90) travel = mean, front = farthest;
    const std::string name = fmt::format("V21 columns, ramp turned by {:.0f} deg", 90 - azimuth);
    expect_within(relative(name + ", centre of mass", "m", mean, travel, 0.02), d.finished);
    expect_within(relative(name + ", front", "m", farthest, front, 0.02), d.finished);
    expect_conserved(d.finished);
  }
}

/// A column that slides to and fro in a frictionless bowl keeps its energy.
TEST(ColumnInABowl, KeepsItsEnergy) {
  Scenario s = block_on_plane(0.0);
  s.formulation = Formulation::depth_averaged;
  s.terrain.synthetic = SyntheticTerrain{"bowl", 1, {{"curvature_radius_m", 60}, {"size_m", 200}}};
  s.release.box = ReleaseBox{{60, 61}, {0, 1}};
  s.release.thickness_m = Uncertain(0.5);
  s.numerics.end_time_s = 200;
  s.numerics.stop_at_rest = false;
  double most = 0, highest = 0;
  const Finished f = run(s, {0.05, [&](double time, const SimulationParts& p) {
                               const MeanMotion m = mean_motion(p.state.grains());
                               most = std::max(most, m.energy_height);
                               if (time > 150) highest = std::max(highest, m.z);
                             }});
  const double drop = 60.5 * 60.5 / 120;
  expect_within(relative("bowl, energy height at the bottom", "m", most, drop, 0.01), f);
  expect_within(relative("bowl, height after a dozen swings", "m", highest, drop, 0.01), f);
}

TEST(ColumnBits, AreTheSameOnTwoThreadsAndBothInstructionSets) {
  Scenario s = columns(ramp_slide(60, 0.6));
  s.numerics.end_time_s = 6;
  auto hash_of = [&](int threads, InstructionSet set) {
    const Finished f = run(build(s, threads, set));
    EXPECT_GT(f.result.scalars.n_particles, 1024);
    return f.result.state_hash;
  };
  const std::uint64_t first = hash_of(1, best_instruction_set());
  EXPECT_EQ(hash_of(1, best_instruction_set()), first);
  EXPECT_EQ(hash_of(2, best_instruction_set()), first);
  if (supports(InstructionSet::avx2)) {
    EXPECT_EQ(hash_of(1, InstructionSet::avx2), first);
  }
}

}  // namespace
}  // namespace sturz::test
