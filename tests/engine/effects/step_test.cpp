// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/step.hpp"

#include "engine/effects/fields.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "tests/support/hand_made.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sturz {
namespace {

using test::even_ground;

constexpr double none = std::numeric_limits<double>::infinity();

/// A pass that notes when it was applied and sets the limits that it was given.
class Note final : public Pass {
 public:
  Note(std::string name, Stage stage, std::vector<std::string>* heard,
       std::vector<StepLimit> limits = {})
      : name_(std::move(name)), stage_(stage), heard_(heard), limits_(std::move(limits)) {}
  std::string_view name() const override { return name_; }
  std::string_view effect() const override { return EffectName::bookkeeping; }
  Stage stage() const override { return stage_; }
  void limits(const State&, std::vector<StepLimit>& out) const override {
    out.insert(out.end(), limits_.begin(), limits_.end());
  }
  void apply(State&, double) override {
    if (heard_) heard_->push_back(name_);
  }
  std::size_t bytes() const override { return 10; }

 private:
  std::string name_;
  Stage stage_;
  std::vector<std::string>* heard_;
  std::vector<StepLimit> limits_;
};

State empty_state() { return State(even_ground(4), {}); }

TEST(Step, AppliesPassesByStageAndThenInTheOrderInWhichTheyCame) {
  Step step;
  std::vector<std::string> heard;
  const std::pair<const char*, Stage> given[] = {
      {"drift", Stage::move},      {"first force", Stage::force},  {"kick", Stage::kick},
      {"lists", Stage::neighbors}, {"second force", Stage::force}, {"ground", Stage::boundary},
      {"yield", Stage::stress},    {"friction", Stage::contact},   {"records", Stage::gather}};
  for (const auto& [name, stage] : given) step.add(std::make_unique<Note>(name, stage, &heard));
  State state = empty_state();
  step.apply(state, 0.1);
  EXPECT_THAT(heard, testing::ElementsAre("lists", "ground", "records", "first force",
                                          "second force", "kick", "friction", "yield", "drift"));
  EXPECT_EQ(step.pass_names()[0], "neighbors: lists");
  EXPECT_EQ(step.pass_names()[4], "force: second force");
  ASSERT_EQ(step.timings().size(), 9u);
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_EQ(step.timings()[k].name, heard[k]);
    EXPECT_GE(step.timings()[k].seconds, 0);
  }
  EXPECT_EQ(step.bytes(), 90u);
}

TEST(Step, TimesByPassAndByEffectHaveTheSameSum) {
  const EffectPart dispersed{EffectName::kinetic_theory, "dispersed groups"};
  const std::vector<PassTime> passes = {{"lists", 1, "grain stress"},
                                        {"sweep", 8, "grain stress", dispersed, 3},
                                        {"warmth", 0.5, "kinetic theory"},
                                        {"ground", 2, "bed"}};
  EXPECT_THAT(by_pass(passes),
              testing::ElementsAre(testing::Pair("lists", 1), testing::Pair("sweep", 5),
                                   testing::Pair("sweep, dispersed groups", 3),
                                   testing::Pair("warmth", 0.5), testing::Pair("ground", 2)));
  EXPECT_THAT(by_effect(passes),
              testing::ElementsAre(testing::Pair("grain stress", 6),
                                   testing::Pair("kinetic theory", 3.5), testing::Pair("bed", 2)));
}

TEST(Step, AdvancesTheClock) {
  Step step;
  State state = empty_state();
  EXPECT_EQ(state.extrapolation(0.1), 0);
  step.apply(state, 0.1);
  step.apply(state, 0.2);
  EXPECT_DOUBLE_EQ(state.time, 0.3);
  EXPECT_EQ(state.previous_dt, 0.2);
  EXPECT_EQ(state.n_steps, 2u);
  EXPECT_DOUBLE_EQ(state.extrapolation(0.3), 1.5);
}

TEST(Step, TheSmallestLimitBindsAndIsNamed) {
  Step step;
  const State state = empty_state();
  EXPECT_EQ(step.limit(state).dt, none);
  EXPECT_STREQ(step.limit(state).name, "none");
  step.add(std::make_unique<Note>("a", Stage::move, nullptr,
                                  std::vector<StepLimit>{{"slow", 3}, {"unbound", none}}));
  EXPECT_STREQ(step.limit(state).name, "slow");
  step.add(
      std::make_unique<Note>("b", Stage::force, nullptr, std::vector<StepLimit>{{"fast", 0.5}}));
  EXPECT_STREQ(step.limit(state).name, "fast");
  EXPECT_EQ(step.limit(state).dt, 0.5);
}

TEST(Step, EveryLimitBindsInItsOwnSituation) {
  auto made = test::grains_on(even_ground(16), test::block({2, 2, 2}), {0, 0, 0});
  MotionBounds& m = made.state.grains().motion;
  const auto binding = [&] { return std::string(made.step.limit(made.state).name); };
  EXPECT_EQ(binding(), "terrain spring");  // 0.2/sqrt(4000) = 3.2 ms < 0.25 * 1.3/60
  EXPECT_DOUBLE_EQ(made.step.limit(made.state).dt, 0.2 / std::sqrt(4000.0));
  m.max_speed = 200;
  EXPECT_EQ(binding(), "acoustic");
  EXPECT_DOUBLE_EQ(made.step.limit(made.state).dt, 0.25 * 1.3 / 260);
  m.max_speed = 0;
  m.max_acceleration = 1e6;
  EXPECT_EQ(binding(), "force");
  EXPECT_DOUBLE_EQ(made.step.limit(made.state).dt, 0.25 * std::sqrt(1.3e-6));

  auto single = test::particles_on(even_ground(16), {{0, 0, 5}}, {400, 0, 0});
  EXPECT_STREQ(single.step.limit(single.state).name, "advection");
  EXPECT_DOUBLE_EQ(single.step.limit(single.state).dt, 0.25 / 400);
  Raster<double> fine(Grid{40, 40, -2, 2, 0.1, ""});
  single.state.terrain = Terrain(std::make_shared<Raster<double>>(fine), NodataRule::outflow);
  EXPECT_STREQ(single.step.limit(single.state).name, "terrain cell");
  EXPECT_DOUBLE_EQ(single.step.limit(single.state).dt, 0.05 / 400);
}

TEST(Step, GrainScenesHoldTheirPassesInOrder) {
  const auto made = test::grains_on(even_ground(16), test::block({2, 2, 2}), {0, 0, 0});
  EXPECT_THAT(
      made.step.pass_names(),
      testing::ElementsAre("neighbors: neighbor lists", "boundary: ground and wall support",
                           "gather: gather", "force: pair sweep", "kick: gravity and kick",
                           "contact: terrain contact", "stress: stress update", "move: motion"));
}

TEST(Step, WhatASceneDoesNotCallForIsNotThere) {
  const auto single = test::particles_on(even_ground(16), {{0, 0, 5}}, {0, 0, 0});
  EXPECT_THAT(single.step.pass_names(),
              testing::ElementsAre("boundary: ground and wall support", "kick: gravity and kick",
                                   "contact: terrain contact", "move: motion"));
  EXPECT_EQ(single.state.grains().find(fields::stress), nullptr);
  Domain walled;
  walled.walls.push_back({{0, 0, 0}, {1, 0, 0}, 0, 1});
  const auto made = test::particles_on(even_ground(16), {{1, 0, 5}}, {0, 0, 0}, walled);
  EXPECT_THAT(made.step.pass_names(), testing::Contains("walls: wall contact"));
}

TEST(Step, FreeFlightFollowsTheParabola) {
  // The first kick takes half a step, from v(0) to v(dt/2); with even steps the rest is exact.
  auto single = test::particles_on(even_ground(200), {{0, 0, 50}}, {20, 5, 0});
  const double dt = 1e-3;
  for (int n = 0; n < 1000; ++n) single.step.apply(single.state, dt);
  const ParticleSet& p = single.state.grains();
  EXPECT_NEAR(p.x[0], 20, 1e-9);
  EXPECT_NEAR(p.y[0], 5, 1e-9);
  EXPECT_NEAR(p.z[0], 50 - 0.5 * 9.81, 1e-9);
}

TEST(Step, BoundsOfTheMotionAreTheExtremes) {
  auto made = test::particles_on(even_ground(16), {{0, 0, 5}, {1, 0, 5}, {2, 0, 5}}, {0, 0, 0});
  ParticleSet& p = made.state.grains();
  p.vx = {3, -1, 0}, p.vy = {4, 0, 0}, p.vz = {0, 0, -2};
  refresh_motion(made.state, made.state.grains(), 0);
  EXPECT_EQ(made.state.grains().motion.max_speed, 5);
  EXPECT_EQ(made.state.grains().motion.velocity_range[0], 4);
  EXPECT_EQ(made.state.grains().motion.velocity_range[2], 2);
  EXPECT_EQ(made.state.grains().ledger.kinetic, 0.5 * 1560 * (25 + 1 + 4));
  EXPECT_TRUE(made.state.grains().motion.finite);
  p.vz[1] = std::nan("");
  refresh_motion(made.state, made.state.grains(), 0);
  EXPECT_FALSE(made.state.grains().motion.finite);
  p.vz[1] = 0;
  p.y[2] = -none;
  refresh_motion(made.state, made.state.grains(), 0);
  EXPECT_FALSE(made.state.grains().motion.finite);
}

TEST(Step, WallsHoldUntilTheyAreTakenAway) {
  Domain gate;
  gate.walls.push_back({{2, 0, 0}, {-1, 0, 0}, 0, 0.5});
  auto single = test::particles_on(even_ground(100, 0), {{0, 0, 0.5}}, {6, 0, 0}, gate, 0);
  while (single.state.time < 0.45) single.advance();
  EXPECT_LT(single.state.grains().x[0], 2);
  single.state.grains().vx[0] = 6;
  while (single.state.time < 1.5) single.advance();
  EXPECT_GT(single.state.grains().x[0], 4);
}

}  // namespace
}  // namespace sturz
