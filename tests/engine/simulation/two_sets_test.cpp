// SPDX-License-Identifier: Apache-2.0
// Two particle sets in one scene: counted together, independent of each other unless they exchange.
#include "tests/support/two_sets.hpp"

#include "engine/simulation/parts.hpp"
#include "tests/support/peak_map_reading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

namespace sturz::test {
namespace {

constexpr double end_time = 1.5, drag = 2e-4;

double mass_of(const MovingSet& set) {
  return std::accumulate(set.mass.begin(), set.mass.end(), 0.0);
}

Vec3 momentum(const MovingSet& p) {
  Vec3 sum(0, 0, 0);
  for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * Vec3(p.vx[i], p.vy[i], p.vz[i]);
  return sum;
}

TEST(TwoSets, AreCountedInMassPeaksHistoryAndFrames) {
  Simulation simulation = simulation_of(sets_of(coarse_and_fine(), 1, drag), end_time);
  const std::vector<MovingSet>& sets = simulation.parts().state.sets;
  const double mass = mass_of(sets[0]) + mass_of(sets[1]);
  const double volume = mass_of(sets[0]) / 1600 + mass_of(sets[1]) / 1400;
  std::map<std::string, std::size_t> frames;
  RunControl control;
  control.on_frame = [&](const ParticleFrame& f) {
    ++frames[std::string(f.set)];
    EXPECT_EQ(f.x.size(), sets[f.set_index].size());
  };
  const MemberResult r = simulation.run(control);
  EXPECT_TRUE(is_valid(r.outcome)) << r.reason;
  EXPECT_EQ(r.scalars.released_mass_kg, mass);
  EXPECT_LT(std::abs(r.scalars.mass_error), 1e-13);
  EXPECT_EQ(r.scalars.n_particles, 8 * 8 * 4 + 10 * 10 * 6);
  EXPECT_NEAR(sum_of(r.layer(PeakLayer::deposit)), volume, 1e-5 * volume);
  EXPECT_GT(frames["coarse"], 2u);
  EXPECT_EQ(frames["coarse"], frames["fine"]);
  const State& s = simulation.parts().state;
  const Ledger both = s.ledger();
  EXPECT_EQ(both.kinetic, sets[0].ledger.kinetic + sets[1].ledger.kinetic);
  EXPECT_FLOAT_EQ(r.history.rows.back().kinetic_energy_j, static_cast<float>(both.kinetic));
  EXPECT_FLOAT_EQ(r.history.rows.back().max_speed_m_s, static_cast<float>(s.max_speed()));
}

/// The second set is thrown off the terrain, the first one stays: only results of the second, and
/// those of both, are cut off by the edge.
TEST(TwoSets, EachIsCutOffByWhatLeftOfIt) {
  std::vector<GrainBox> boxes = coarse_and_fine();
  boxes[1].velocity = Vec3(80, 0, 4);
  const MemberResult r = simulation_of(sets_of(boxes), end_time, true).run();
  const MemberScalars& m = r.scalars;
  EXPECT_EQ(r.outcome, Outcome::left_terrain) << r.reason;
  EXPECT_EQ(m.solid_lost_fraction, 0);
  EXPECT_GT(m.liquid_lost_fraction, 0.5);
  EXPECT_EQ(m.liquid_lost_mass_kg, m.lost_mass_kg);
  EXPECT_TRUE(has_left(censoring_of(Phase::both, m, r.censoring)));
  EXPECT_TRUE(has_left(censoring_of(Phase::liquid, m, r.censoring)));
  EXPECT_FALSE(has_left(censoring_of(Phase::grains, m, r.censoring)));
  EXPECT_NE(r.reason.find("(0 % of the grains, "), std::string::npos) << r.reason;
  EXPECT_GT(m.liquid_runout_m, m.solid_runout_m);
  EXPECT_GT(m.liquid_front_travel_m, 25);
  const MemberResult dry = simulation_of(sets_of(boxes), end_time).run();
  EXPECT_TRUE(std::isnan(dry.scalars.liquid_lost_fraction));
  EXPECT_EQ(dry.state_hash, r.state_hash);
}

TEST(TwoSets, TheHashSeesBoth) {
  std::uint64_t hash[3];
  for (int changed : {0, 1, 2}) {
    HandMade made = sets_of(coarse_and_fine());
    if (changed > 0) made.state.sets[changed - 1].x[3] += 1e-9;
    hash[changed] = simulation_of(std::move(made), 0.2).run().state_hash;
  }
  EXPECT_NE(hash[0], hash[1]);
  EXPECT_NE(hash[0], hash[2]);
  EXPECT_NE(hash[1], hash[2]);
}

TEST(TwoSets, GiveTheSameBitsOnTwoThreads) {
  const auto hash = [](int threads) {
    return simulation_of(sets_of(coarse_and_fine(), threads, drag), 1).run().state_hash;
  };
  EXPECT_EQ(hash(2), hash(1));
}

/// Without exchange each moves to the bit as if it were alone.
TEST(TwoSets, DoNotKnowOfEachOtherWithoutExchange) {
  const std::vector<GrainBox> boxes = coarse_and_fine();
  HandMade both = sets_of(boxes), coarse = sets_of({boxes[0]}), fine = sets_of({boxes[1]});
  for (int step = 0; step < 300; ++step) {
    const double dt = step == 0                              ? 1e-4
                      : both.state.previous_dt * 1.01 < 2e-3 ? both.state.previous_dt * 1.01
                                                             : 2e-3;
    for (HandMade* made : {&both, &coarse, &fine}) made->step.apply(made->state, dt);
  }
  EXPECT_EQ(both.state.sets[0].z, coarse.state.grains().z);
  EXPECT_EQ(both.state.sets[1].z, fine.state.grains().z);
  EXPECT_EQ(both.state.sets[1].vx, fine.state.grains().vx);
  EXPECT_EQ(both.state.sets[0].ledger.residual(), coarse.state.grains().ledger.residual());
}

TEST(TwoSets, ExchangeMomentumThroughCrossPairs) {
  HandMade made = sets_of(coarse_and_fine(), 1, drag);
  State& s = made.state;
  s.gravity = 0;
  const Vec3 before = momentum(s.sets[0]) + momentum(s.sets[1]);
  const double slip0 = s.sets[1].vz[0] - s.sets[0].vz[0];
  while (s.time < 0.6) made.advance();
  const Vec3 after = momentum(s.sets[0]) + momentum(s.sets[1]);
  const double scale = mass_of(s.sets[0]) * 4 + mass_of(s.sets[1]) * 8;
  EXPECT_LT((after - before).norm(), 1e-5 * scale);
  const double slip =
      momentum(s.sets[1]).z() / mass_of(s.sets[1]) - momentum(s.sets[0]).z() / mass_of(s.sets[0]);
  EXPECT_LT(slip, 0.9 * slip0) << "they brake each other";
}

/// Two columns of different density on one cell: thickness adds, pressure is that of the mixture.
TEST(TwoSets, PeaksCountEachSetByItsOwnDensity) {
  MovingSet sets[2];
  const double density[] = {1000, 2500}, speed[] = {4, 8};
  for (int k : {0, 1}) {
    sets[k].spacing = 0.5 + k;
    sets[k].bulk_density = density[k];
    sets[k].grow(400);
    for (int i = 0; i < 400; ++i) {  // 1 m and 2 m of flow on 20 x 20 m
      sets[k].x[i] = i % 20 - 9.5, sets[k].y[i] = i / 20 - 9.5;
      sets[k].vx[i] = speed[k];
      sets[k].mass[i] = density[k] * (1 + k);
    }
  }
  PeakMaps maps({Grid{64, 64, -32, 32, 1, ""}, 0.05});
  maps.record(sets, 0);
  MemberResult r;
  maps.finish(sets, r);
  const int row = r.grid.row_of(0.5), col = r.grid.col_of(0.5);
  const double mass = 1000 + 5000, v = (1000 * 4 + 5000 * 8) / mass;
  EXPECT_NEAR(at(r, PeakLayer::thickness, row, col), 3, 1e-5);
  EXPECT_NEAR(at(r, PeakLayer::deposit, row, col), 3, 1e-5);
  EXPECT_NEAR(at(r, PeakLayer::speed, row, col), v, 1e-5);
  EXPECT_NEAR(at(r, PeakLayer::energy, row, col), 0.5 * (1000 * 16 + 5000 * 64), 1);
  EXPECT_NEAR(at(r, PeakLayer::pressure, row, col), mass / 3 * v * v, 0.1);
  // 3 m are six layers of the first set and two of the second: 5000 of 6000 kg are thin.
  EXPECT_NEAR(maps.layers().thin_fraction, 5.0 / 6, 0.05);
}

}  // namespace
}  // namespace sturz::test
