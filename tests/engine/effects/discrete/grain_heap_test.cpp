// SPDX-License-Identifier: Apache-2.0
/// Many grains: what is kept, what is booked, the same bits.
#include "engine/effects/discrete/pairs.hpp"
#include "tests/support/discrete_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace sturz {
namespace {

using test::GrainRun;
using test::GrainScene;
using test::heap;
using test::SetDown;

/// A ball of grains that fly towards its middle, without weight.
std::vector<SetDown> implosion(double speed) {
  std::vector<SetDown> grains = heap(5, 1.3, 0.1, 0.2);
  for (SetDown& each : grains) {
    each.velocity = -speed / 4 * (each.position - Vec3(0, 0, 3)) + Vec3(1, 2, 0);
    each.position.z() += 20;
  }
  return grains;
}

GrainScene weightless() {
  GrainScene scene;
  scene.gravity = 0;
  scene.grains.rolling_friction = 0.1;
  return scene;
}

TEST(GrainHeap, KeepsMomentumAndAngularMomentumToRounding) {
  GrainRun run(implosion(5), weightless());
  const Vec3 momentum = run.momentum(), angular = run.angular_momentum();
  double scale = 0;
  for (const double m : run.grains().mass) scale += m * 5;
  for (int k = 1; k <= 8; ++k) {
    run.run(0.1 * k, 1e-3);
    ASSERT_LT((run.momentum() - momentum).norm(), 1e-12 * scale);
    ASSERT_LT((run.angular_momentum() - angular).norm(), 1e-11 * 20 * scale);
  }
  EXPECT_GT(run.ledger().plastic, 0);
  EXPECT_LT(run.ledger().stress_impulse.norm(), 1e-12 * run.ledger().stress_impulse_scale);
}

/// Energy of motion, spins and springs, and what was dissipated, less what there was, over that.
double unexplained(const GrainRun& run) {
  const Ledger& l = run.ledger();
  const double now = l.kinetic + l.rotational + l.elastic + l.plastic + l.friction + l.collisions;
  return (now + l.potential + l.lost_energy - l.kinetic_0) / l.kinetic_0;
}

TEST(GrainHeap, EnergyIsBookedAndTheBooksSeeATooLongStep) {
  double last = 1;
  for (const double dt : {4e-3, 2e-3, 1e-3}) {
    GrainRun run(implosion(5), weightless());
    run.run(1.2, dt);
    const Ledger& l = run.ledger();
    EXPECT_GT(l.collisions, 0.1 * l.kinetic_0);
    EXPECT_GT(l.plastic, 0.02 * l.kinetic_0);
    // What no account explains is the numerical one, and neither is zero by construction.
    EXPECT_NEAR(unexplained(run) * l.kinetic_0, -l.numerical(), 1e-9 * l.kinetic_0);
    EXPECT_LT(std::abs(l.residual()), 1e-9 * l.kinetic_0);
    const double error = std::abs(unexplained(run));
    EXPECT_GT(error, 0);
    EXPECT_LT(error, last) << dt;
    last = error;
  }
  EXPECT_LT(last, 0.005);
}

TEST(GrainHeap, WithoutLossesEnergyStays) {
  GrainScene scene = weightless();
  scene.grains.restitution = 1;
  scene.grains.friction = scene.grains.rolling_friction = 0;
  GrainRun run(implosion(5), scene);
  run.run(1.2, 1e-3);
  const Ledger& l = run.ledger();
  EXPECT_NEAR(l.kinetic + l.elastic, l.kinetic_0, 0.005 * l.kinetic_0);
  EXPECT_LT(std::abs(l.collisions) + std::abs(l.plastic), 1e-9 * l.kinetic_0);
}

TEST(GrainHeap, SettingDownSetsNoEnergyFree) {
  GrainScene scene;
  scene.gravity = 0;
  GrainRun run(heap(5, 0.95, 0.02), scene);  // all overlap, the lowest the ground, too
  run.run(0.5, 1e-3);
  EXPECT_EQ(run.ledger().kinetic, 0);
  EXPECT_EQ(run.ledger().elastic, 0);
}

TEST(GrainHeap, GivesTheSameBitsAtOneAndTwoThreads) {
  GrainScene scene;
  scene.grains.rolling_friction = 0.1;
  scene.grains.bed_rolling_friction.reset();
  GrainRun one(heap(12, 1.02), scene, 1), two(heap(12, 1.02), scene, 2);
  for (GrainRun* run : {&one, &two}) run->run(0.3, 2e-3);
  ASSERT_EQ(one.grains().x, two.grains().x);
  ASSERT_EQ(one.grains().z, two.grains().z);
  ASSERT_EQ(one.grains().vy, two.grains().vy);
  ASSERT_EQ(one.grains().components(fields::spin), two.grains().components(fields::spin));
  EXPECT_EQ(one.ledger().plastic, two.ledger().plastic);
  EXPECT_EQ(one.ledger().friction, two.ledger().friction);
  EXPECT_GT(one.ledger().friction, 0);
}

TEST(GrainHeap, WhatLeavesTheGroundIsAccountedFor) {
  GrainScene scene;
  scene.cells = 8;
  scene.grains.bed[0].friction_coefficient = 0;
  std::vector<SetDown> grains = heap(4, 1.0);
  for (SetDown& each : grains) each.velocity.x() = 6;
  GrainRun run(grains, scene);
  double mass = 0;
  for (const double m : run.grains().mass) mass += m;
  run.run(2.5, 2e-3);
  const Ledger& l = run.ledger();
  EXPECT_LT(run.grains().size(), 64u);
  double left = 0;
  for (const double m : run.grains().mass) left += m;
  EXPECT_NEAR(left + l.lost_mass, mass, 1e-9 * mass);
  EXPECT_LT(std::abs(l.numerical()), 0.02 * l.kinetic_0);
}

TEST(GrainHeap, APeriodJoinsTheTwoEndsOfABox) {
  GrainScene scene = weightless();
  scene.domain.x = {true, -4, 4, 0};
  GrainRun run({{{-3.6, 0, 10}, {-2, 0, 0}}, {{3.0, 0, 10}, {0, 0, 0}}}, scene);
  run.run(2, 1e-3);
  EXPECT_LT(run.velocity(1).x(), -1) << "hit across the seam";
  EXPECT_NEAR(run.momentum().x(), -2 * run.grains().mass[0], 1e-9 * run.grains().mass[0]);
}

/// Slope of the cone with the same mean height and mean distance from its axis [degrees].
double repose_angle(double rolling) {
  GrainScene scene;
  scene.grains.rolling_friction = rolling;
  scene.grains.bed[0].friction_coefficient = 0.8;
  scene.grains.bed_rolling_friction.reset();
  GrainRun run(heap(7, 1.02, 0.05, 0.1), scene);
  run.run(6, 3e-3);
  EXPECT_LT(run.ledger().kinetic, 1e-3 * run.ledger().released_energy());
  double height = 0, distance = 0;
  for (std::size_t i = 0; i < run.grains().size(); ++i) {
    height += run.position(i).z();
    distance += std::hypot(run.position(i).x(), run.position(i).y());
  }
  return std::atan(2 * height / distance) * 180 / std::numbers::pi;
}

TEST(GrainHeap, AHeapStandsAtAPlausibleAngle) {
  const double smooth = repose_angle(0), rough = repose_angle(0.4);
  RecordProperty("angle_without_rolling_friction", std::to_string(smooth));
  RecordProperty("angle_with_rolling_friction", std::to_string(rough));
  EXPECT_GT(smooth, 10) << rough;
  EXPECT_GT(rough, smooth);
  EXPECT_LT(rough, 50) << smooth;
}

TEST(GrainPairs, HoldEveryPairThatTouchesAsTheGrainsMove) {
  std::vector<SetDown> grains = heap(6, 1.1, 0.3, 0.2);
  GrainScene scene = weightless();
  scene.domain.y = {true, -3.3, 3.3, 0};
  for (std::size_t i = 0; i < grains.size(); ++i)
    grains[i].velocity = Vec3(std::sin(1.0 * i), std::cos(2.0 * i), std::sin(3.0 * i) + 40);
  GrainRun run(grains, scene);
  GrainPairs pairs(0.2);
  std::vector<double> radius;
  for (std::size_t i = 0; i < grains.size(); ++i) radius.push_back(run.radius(i));
  MovingSet& p = run.grains();
  const double length = scene.domain.y.length();
  for (int n = 0; n < 60; ++n) {
    pairs.update(scene.domain, p, radius, 1);
    std::set<std::pair<std::uint32_t, std::uint32_t>> listed;
    for (const GrainPair& pair : pairs.pairs()) {
      const double gap = (run.position(pair.a) - run.position(pair.b) - pair.image).norm();
      if (gap < radius[pair.a] + radius[pair.b]) listed.insert({pair.a, pair.b});
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> touching;
    for (std::uint32_t i = 0; i < p.size(); ++i)
      for (std::uint32_t j = i + 1; j < p.size(); ++j)
        for (const int turn : {-1, 0, 1}) {
          const Vec3 r = run.position(i) - run.position(j) - Vec3(0, turn * length, 0);
          if (r.norm() < radius[i] + radius[j]) touching.insert({i, j});
        }
    ASSERT_EQ(listed, touching) << n;
    for (std::size_t i = 0; i < p.size(); ++i)
      p.x[i] += 0.02 * p.vx[i], p.y[i] += 0.02 * p.vy[i], p.z[i] += 0.02 * p.vz[i];
  }
  EXPECT_GT(pairs.n_lists(), 2u);
  EXPECT_LT(pairs.n_lists(), 40u) << "a motion that all share asks for no new lists";
}

}  // namespace
}  // namespace sturz
