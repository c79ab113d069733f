// SPDX-License-Identifier: Apache-2.0
// Particles that come and go during a run: identity is an id, and the ledger follows it.
#include "engine/effects/arrivals.hpp"

#include "engine/effects/fields.hpp"
#include "engine/simulation/parts.hpp"
#include "engine/simulation/travel.hpp"
#include "tests/support/hand_made.hpp"
#include "tests/support/two_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace sturz::test {
namespace {

/// Four grains a second through a gate above the ground, in rows; and every so often one is taken.
class Feed final : public Pass {
 public:
  Feed(double mass, bool takes) : mass_(mass), takes_(takes) {}
  std::string_view name() const override { return "feed"; }
  std::string_view effect() const override { return "feed"; }
  Stage stage() const override { return Stage::stress; }

  void apply(State& s, double) override {
    MovingSet& p = s.grains();
    for (; n_ < 20 * s.time && n_ < 60; ++n_)
      p.arrivals.push_back({{-6.0 + n_ % 4, -2.0 + n_ / 4 % 4, 4.0}, {1.5, 0, 0}, mass_});
    if (!takes_ || s.n_steps % 50 != 49 || p.size() < 20) return;
    const auto oldest = std::min_element(p.id.begin(), p.id.end()) - p.id.begin();
    p.fate[static_cast<std::size_t>(oldest)] = Fate::taken;
    p.any_leaving = true;
    ++taken;
  }
  int taken = 0;

 private:
  double mass_;
  bool takes_;
  int n_ = 0;
};

struct Fed {
  MemberResult result;
  std::vector<std::uint32_t> ids;
  std::map<std::uint32_t, double> last_x;  // by id, of the frames
  double jumped = 0;                       // farthest that an id moved between frames [m]
  int taken = 0;
  Ledger ledger;
};

Fed run_fed(int threads, bool takes, double end_time = 2.5) {
  HandMade made = grains_on(even_ground(40), block({3, 3, 2}, {4, 4, 0}), {0, 0, 0});
  made.state.threads = threads;
  auto feed = std::make_unique<Feed>(1560, takes);
  const Feed& fed = *feed;
  made.step.add(std::move(feed));
  Simulation simulation = simulation_of(std::move(made), end_time);
  Fed out;
  RunControl control;
  control.frame_every_s = 0.02;
  control.on_frame = [&](const ParticleFrame& f) {
    for (std::size_t i = 0; i < f.id.size(); ++i) {
      const auto known = out.last_x.find(f.id[i]);
      if (known != out.last_x.end())
        out.jumped = std::max(out.jumped, std::abs(f.x[i] - known->second));
      out.last_x[f.id[i]] = f.x[i];
    }
  };
  out.result = simulation.run(control);
  out.ids = simulation.parts().state.grains().id;
  out.taken = fed.taken;
  out.ledger = simulation.parts().state.ledger();
  return out;
}

TEST(Arrivals, BringMassAndEnergyIntoTheLedger) {
  const Fed f = run_fed(1, false);
  EXPECT_TRUE(is_valid(f.result.outcome)) << f.result.reason;
  EXPECT_EQ(f.result.scalars.n_particles, 18 + 50);
  EXPECT_NEAR(f.ledger.added_mass, 50 * 1560.0, 1e-9);
  EXPECT_NEAR(f.ledger.added_energy, 50 * 0.5 * 1560 * 1.5 * 1.5, 1e-6);
  EXPECT_LT(std::abs(f.result.scalars.mass_error), 1e-13);
  EXPECT_LT(std::abs(f.ledger.residual()),
            0.02 * (f.ledger.released_energy() + f.ledger.added_energy));
}

TEST(Arrivals, AreFollowedByIdInTravelAndFrames) {
  const Fed f = run_fed(1, true);
  EXPECT_EQ(std::set<std::uint32_t>(f.ids.begin(), f.ids.end()).size(), f.ids.size());
  EXPECT_GT(*std::max_element(f.ids.begin(), f.ids.end()), 40u);
  EXPECT_GT(f.taken, 3);
  EXPECT_LT(f.jumped, 0.5) << "an id jumped: it names another particle than before";
  // Those that entered at x = -6 .. -3 moved east by a few metres; counted from another's start
  // they would have come ten.
  EXPECT_LT(f.result.scalars.front_travel_m, 6);
  EXPECT_GT(f.result.scalars.front_travel_m, 1);
  EXPECT_LT(std::abs(f.result.scalars.mass_error), 1e-13);
  EXPECT_NEAR(f.ledger.taken_mass, f.taken * 1560.0, 1e-9);
  EXPECT_EQ(f.ledger.lost_mass, 0);
  EXPECT_NE(f.result.outcome, Outcome::left_terrain) << "what an effect takes has not left";
}

TEST(Arrivals, GiveTheSameBitsOnTwoThreads) {
  EXPECT_EQ(run_fed(2, true, 1).result.state_hash, run_fed(1, true, 1).result.state_hash);
}

/// Columns get ground, support and thickness of their own when they enter.
TEST(Arrivals, ColumnsEnterOnTheGround) {
  std::vector<Vec3> positions;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) positions.emplace_back(i + 0.5, j + 0.5, 0);
  HandMade made = columns_on(even_ground(60, 0.3), positions, 1.0, {0, 0, 0});
  MovingSet& p = made.state.grains();
  for (int step = 0; step < 20; ++step) made.advance();
  for (int k = 0; k < 12; ++k)
    p.arrivals.push_back({{-8.0 - k % 4, k / 4 + 0.5, 99}, {2, 0, 0}, 1560});
  for (int step = 0; step < 200; ++step) made.advance();
  ASSERT_EQ(p.size(), 48u);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_TRUE(std::isfinite(p.x[i] + p.z[i] + p.vx[i]));
    EXPECT_NEAR(p.z[i], made.state.terrain.curved(p.x[i], p.y[i]).z, 1e-12);
    EXPECT_GT(p.scalar(fields::support_radius)[i], 0.5);
    EXPECT_GT(p.scalar(fields::thickness)[i], 0);
  }
  EXPECT_LT(std::abs(p.ledger.residual()), 0.05 * p.ledger.available_energy());
  std::vector<ParticleTravel> each;
  EXPECT_LT(measure(made.state, each).front, 15);
  EXPECT_NEAR(p.ledger.added_mass, 12 * 1560.0, 1e-9);
}

/// The step that an arrival moves in is chosen with it.
TEST(Arrivals, AFastOneShortensItsFirstStep) {
  std::vector<Vec3> places;
  for (int i = 0; i < 36; ++i) places.emplace_back(i % 6 + 0.5, i / 6 + 0.5, 0);
  HandMade made = columns_on(even_ground(60), places, 1.0, {0, 0, 0});
  MovingSet& p = made.state.grains();
  for (int step = 0; step < 20; ++step) made.advance();
  p.arrivals.push_back({{-20.5, 3.5, 0}, {100, 0, 0}, 1560});
  made.step.admit(made.state);
  const std::size_t i = p.size() - 1;
  const std::uint32_t id = p.id[i];
  const double before = p.x[i];
  made.advance();
  const auto now = std::find(p.id.begin(), p.id.end(), id) - p.id.begin();
  EXPECT_LT(p.x[static_cast<std::size_t>(now)] - before, 1.0) << "at most about a cell";
}

/// Ground that sinks or rises under columns is no slope: they keep their speed.
TEST(Arrivals, ColumnsKeepTheirSpeedOverGroundThatMoves) {
  for (const double moved : {-0.5, 0.2}) {
    std::vector<Vec3> places;
    for (int i = 0; i < 36; ++i) places.emplace_back(i % 6 + 0.5, i / 6 + 0.5, 0);
    HandMade made = columns_on(even_ground(60), places, 0.2, {3, 0, 0});
    for (int step = 0; step < 10; ++step) made.advance();
    const MovingSet& p = made.state.grains();
    const double before = p.ledger.kinetic, unexplained = p.ledger.residual();
    std::vector<NodeChange> all;
    for (int r = 0; r < 60; ++r)
      for (int c = 0; c < 60; ++c) all.push_back({r, c, moved});
    made.state.terrain.change(all);
    made.advance();
    made.advance();
    EXPECT_NEAR(p.ledger.kinetic, before, 0.2 * before) << moved;
    EXPECT_NEAR(p.ledger.residual(), unexplained, 0.02 * before) << moved;
    EXPECT_NEAR(p.z[0], moved, 1e-9);
  }
}

/// The ground under one layer of grains at rest sinks: they follow it down, and nothing is lost.
TEST(Arrivals, GrainsFollowGroundThatSinksUnderThem) {
  HandMade made = grains_on(even_ground(40), block({6, 6, 1}, {-3, -3, 0}), {0, 0, 0}, {}, 0.6);
  for (int step = 0; step < 300; ++step) made.advance();
  const double before = made.state.grains().ledger.potential;
  std::vector<NodeChange> sunk;
  for (int r = 8; r < 32; ++r)
    for (int c = 8; c < 32; ++c) sunk.push_back({r, c, -0.8});
  made.state.terrain.change(sunk);
  for (int step = 0; step < 3000; ++step) made.advance();
  const MovingSet& p = made.state.grains();
  EXPECT_EQ(p.size(), 36u);
  double lowest = 1e9;
  for (double z : p.z) lowest = std::min(lowest, z);
  EXPECT_NEAR(lowest, -0.8 + 0.5, 0.15);
  const double fall = 0.8 * 9.81 * p.ledger.released_mass;
  EXPECT_NEAR(before - p.ledger.potential, fall, 0.15 * fall);
}

}  // namespace
}  // namespace sturz::test
