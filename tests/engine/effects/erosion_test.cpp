// SPDX-License-Identifier: Apache-2.0
/// A bed that columns take along, step by step: momentum, accounts, supply.
#include "engine/effects/erosion/effect.hpp"
#include "engine/effects/fields.hpp"
#include "tests/support/hand_made.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sturz {
namespace {

using test::block;
using test::columns_on;
using test::even_ground;
using test::HandMade;

constexpr double endless = std::numeric_limits<double>::infinity();

double total(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

ErosionSettings growing(double per_m, double depth_m = endless) {
  ErosionSettings e;
  e.law.growth_rate = per_m;
  e.bed_density = 1560;
  e.bed = {BasalResistance{0.2}};
  e.source.depth_m = depth_m;
  e.cells = {8, 8, -4, 4, 1, ""};
  return e;
}

DepthAveragedSettings smooth(double friction) {
  DepthAveragedSettings s;
  s.density = 1560;
  s.bed = {BasalResistance{friction}};
  return s;
}

/// A sheet of 8 x 8 columns that fills the ground and repeats both ways.
HandMade sheet(double slope, double friction, const Vec3& velocity) {
  Domain domain;
  domain.x.active = domain.y.active = true;
  domain.x.min = domain.y.min = -4, domain.x.max = domain.y.max = 4;
  domain.x.rise = -8 * slope;
  return columns_on(even_ground(16, slope), block({8, 8, 1}, {-4, -4, 0}), 1, velocity, domain,
                    smooth(friction));
}

HandMade eroding(HandMade made, const ErosionSettings& e) {
  made.state.grains().bulk_density = 1560;
  add_erosion(made.step, made.state, 0, e);
  return made;
}

/// d(kinetic) that no account explains [J].
double unexplained(const Ledger& l) {
  return l.kinetic - l.kinetic_0 - l.gravity_work - l.stress_work - l.contact_work + l.friction +
         l.lost_energy + l.entrainment_loss;
}

Vec3 momentum(const MovingSet& p) {
  Vec3 m(0, 0, 0);
  for (std::size_t i = 0; i < p.size(); ++i) m += p.mass[i] * Vec3(p.vx[i], p.vy[i], p.vz[i]);
  return m;
}

TEST(ErodingColumns, KeepTheirMomentumOnLevelFrictionlessGround) {
  HandMade made = eroding(sheet(0, 0, {10, 0, 0}), growing(0.01));
  const MovingSet& p = made.state.grains();
  const Vec3 before = momentum(p);
  const double mass = total(p.mass);
  for (int n = 0; n < 200; ++n) made.advance();
  EXPECT_NEAR((momentum(p) - before).norm(), 0, 1e-6 * before.norm());
  EXPECT_GT(total(p.mass), 1.3 * mass);
  const Ledger& l = p.ledger;
  EXPECT_NEAR(total(p.mass), mass + l.entrained_mass, 1e-14 * total(p.mass));
  // What is left of M v^2/2 when M v stays; pair forces are of single precision.
  EXPECT_NEAR(l.kinetic, l.kinetic_0 * mass / total(p.mass), 1e-6 * l.kinetic_0);
  EXPECT_NEAR(l.entrainment_loss, l.kinetic_0 - l.kinetic, 1e-6 * l.kinetic_0);
  EXPECT_NEAR(unexplained(l), 0, 1e-10 * l.kinetic_0);
}

TEST(ErodingColumns, FollowTheBlockThatGrowsWithItsPath) {
  const double slope = std::tan(25 * 0.017453292519943295), per_m = 5e-3;
  const double a =
      standard_gravity * (std::sin(std::atan(slope)) - 0.2 * std::cos(std::atan(slope)));
  std::vector<double> error, growth;
  for (const double dt : {0.1, 0.05, 0.025}) {
    HandMade made = eroding(sheet(slope, 0.2, {0, 0, 0}), growing(per_m));
    MovingSet& p = made.state.grains();
    const double mass = total(p.mass);
    double x = 0;
    for (double t = 0; t < 5 - 1e-9; t += dt) {
      made.step.apply(made.state, dt);
      x += dt * total(p.vx) / p.size();
    }
    const double path = x / std::cos(std::atan(slope));
    const double exact = std::log(std::cosh(5 * std::sqrt(a * per_m))) / per_m;
    const double half = 5 - 0.5 * dt;
    error.push_back(path / exact - 1);
    growth.push_back(total(p.mass) / mass / std::cosh(half * std::sqrt(a * per_m)) - 1);
    EXPECT_NEAR(unexplained(p.ledger), 0, 1e-9 * p.ledger.kinetic);
    EXPECT_NEAR(p.ledger.residual(), 0, 1e-3 * p.ledger.kinetic);
  }
  EXPECT_LT(std::abs(error[0]), 1e-4);
  EXPECT_LT(std::abs(growth[0]), 4e-4);
  EXPECT_LT(std::abs(error[2]), std::abs(error[0]) / 2.5);
  EXPECT_LT(std::abs(growth[2]), std::abs(growth[0]) / 2.5);
}

TEST(ErodingColumns, ShareWhatACellHasLeft) {
  HandMade made = eroding(sheet(0.3, 0.2, {6, 0, 0}), growing(0.5, 0.2));
  const double area = 64;
  for (int n = 0; n < 60; ++n) {
    made.advance();
    double deepest = 0;
    made.state.bed_supply->visit_eroded(
        [&](int, int, double depth) { deepest = std::max(deepest, depth); });
    ASSERT_LE(deepest, 0.2 * (1 + 1e-12));
  }
  const MovingSet& p = made.state.grains();
  EXPECT_NEAR(made.state.bed_supply->eroded_volume_m3(), 0.2 * area, 1e-12);
  EXPECT_NEAR(p.ledger.entrained_mass, 1560 * 0.2 * area, 1e-9);
  const auto& entrained = p.scalar(fields::entrained_mass);
  EXPECT_NEAR(total(entrained), p.ledger.entrained_mass, 1e-9);
  EXPECT_GT(*std::min_element(entrained.begin(), entrained.end()), 0) << "each got its share";
}

TEST(ErodingColumns, AreTheSameAtAnyNumberOfThreads) {
  std::vector<double> first;
  for (const int threads : {1, 2, 3}) {
    HandMade made = eroding(sheet(0.3, 0.2, {6, 0, 0}), growing(0.02, 0.3));
    made.state.threads = threads;
    for (int n = 0; n < 30; ++n) made.advance();
    if (first.empty()) first = made.state.grains().mass;
    EXPECT_EQ(made.state.grains().mass, first) << threads;
  }
}

TEST(ErodingColumns, TellWhatTheyReceive) {
  ErosionSettings e = growing(0.02);
  double told = 0;
  e.received = [&](MovingSet& p, std::span<const double> gained, double share) {
    ASSERT_EQ(gained.size(), p.size());
    told += share * std::accumulate(gained.begin(), gained.end(), 0.0);
  };
  HandMade made = eroding(sheet(0.3, 0.2, {6, 0, 0}), e);
  for (int n = 0; n < 20; ++n) made.advance();
  EXPECT_NEAR(told, made.state.grains().ledger.entrained_mass, 1e-11 * told);
  EXPECT_GT(told, 0);
}

TEST(ErodingColumns, LeaveTheGroundWithTheirShareOfEveryAccount) {
  ErosionSettings e = growing(0.05);
  e.cells = {16, 16, -8, 8, 1, ""};
  HandMade made = eroding(columns_on(even_ground(16, 0.2), block({6, 5, 1}, {1, -2, 0}), 0.7,
                                     {9, 1, 0}, {}, smooth(0.2)),
                          e);
  const MovingSet& p = made.state.grains();
  const double released = total(p.mass);
  for (int n = 0; n < 200 && p.size() > 0; ++n) {
    made.advance();
    const Ledger& l = p.ledger;
    ASSERT_NEAR(total(p.mass) + l.lost_mass, released + l.entrained_mass,
                1e-13 * (released + l.entrained_mass));
    ASSERT_NEAR(unexplained(l), 0, 1e-9 * l.kinetic_0);
  }
  EXPECT_GT(p.ledger.lost_mass, released);
  EXPECT_GT(p.ledger.entrained_mass, 0);
}

}  // namespace
}  // namespace sturz
