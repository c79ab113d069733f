// SPDX-License-Identifier: Apache-2.0
// What ground and walls do to a liquid along them.
#include "engine/effects/bed/flow_depth.hpp"
#include "engine/effects/bed/liquid_contact.hpp"
#include "tests/support/liquid/liquid_scene.hpp"
#include "tests/support/sweep/sweep_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace sturz {
namespace {

/// Layers of one spacing on a lattice that is turned about the vertical and shifted.
MovingSet layers(int along, int n_layers, double dx, double turn, const Vec3& shift) {
  MovingSet p;
  const auto cloud = test::lattice({along, along, n_layers}, dx, 0, {0, 0, 0.5 * n_layers * dx});
  p.grow(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3& at = cloud[i].position;
    p.x[i] = std::cos(turn) * at.x() - std::sin(turn) * at.y() + shift.x();
    p.y[i] = std::sin(turn) * at.x() + std::cos(turn) * at.y() + shift.y();
    p.z[i] = at.z();
    p.mass[i] = 1000 * dx * dx * dx;
    p.boundary.distance.push_back(static_cast<float>(at.z()));
  }
  return p;
}

TEST(FlowDepth, OfALayerIsItsVolumeOverItsAreaWhereverItLies) {
  const double dx = 0.5;
  for (const double turn : {0.0, 0.3, 0.785}) {
    const MovingSet p = layers(24, 3, dx, turn, {1234.567, -8.9, 0});
    FlowDepth depth(dx, 1.5 * dx);
    depth.measure({}, p, 1000);
    int inside = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (std::hypot(p.x[i] - 1234.567, p.y[i] + 8.9) > 8 * dx) continue;
      // Dealing out leaves sinc^2 sinc^2 of each wave of the lattice: by the first two of them,
      // four directions each, at most 4 (0.22 % + 0.34 %), turned by 45 degrees.
      EXPECT_NEAR(depth.depth(i), 3 * dx, 0.0225 * 3 * dx);
      EXPECT_NEAR(depth.beside_ground(i), dx, 0.0225 * dx) << "the second lies at its limit";
      ++inside;
    }
    EXPECT_GT(inside, 400);
  }
}

TEST(FlowDepth, GoesRoundAPeriod) {
  const double dx = 0.5;
  MovingSet p = layers(10, 2, dx, 0, {0, 0, 0});
  Domain domain;
  domain.x = {true, -5 * dx, 5 * dx, 0};
  domain.y = {true, -5 * dx, 5 * dx, 0};
  FlowDepth depth(dx, 2.6 * dx);
  depth.measure(domain, p, 1000);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_NEAR(depth.depth(i), 2 * dx, 1e-12);
    EXPECT_NEAR(depth.beside_ground(i), 2 * dx, 1e-12);
  }
}

TEST(FlowDepth, IsLowerTowardsAMarginAndNeverNegative) {
  const double dx = 0.5;
  const MovingSet p = layers(20, 2, dx, 0.2, {0.13, 0.4, 0});
  FlowDepth depth(dx, 2.6 * dx);
  depth.measure({}, p, 1000);
  double least = 1e9, largest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    least = std::min(least, depth.depth(i)), largest = std::max(largest, depth.depth(i));
    EXPECT_LE(depth.beside_ground(i), depth.depth(i) * (1 + 1e-12));
  }
  EXPECT_GT(least, 0.2 * dx);
  EXPECT_LT(least, 1.3 * dx);
  EXPECT_LT(largest, 2.1 * dx);
}

/// Terminal speed of a drag under a pull of 2 m/s^2 along x, with steps of one length.
double terminal_speed(const SurfaceDrag& law, double dt, int steps) {
  Vec3 v(0, 0, 0);
  for (int k = 0; k < steps; ++k) {
    const Vec3 before = v;
    v.x() += 2 * dt;
    drag_along(
        Vec3(0, 0, 1), before, dt, [&](double) { return law; }, v.x(), v.y(), v.z());
  }
  return v.x();
}

TEST(DragAlong, HasItsSteadySpeedAtAnyLengthOfStep) {
  for (const double dt : {1e-3, 0.1, 10.0, 1e6}) {
    EXPECT_NEAR(terminal_speed({0, 5}, dt, dt < 0.01 ? 5000 : 200), 2.0 / 5, 1e-9) << dt;
    EXPECT_NEAR(terminal_speed({1.5, 5}, dt, dt < 0.01 ? 5000 : 200), 0.5 / 5, 1e-9) << dt;
    EXPECT_EQ(terminal_speed({2.5, 5}, dt, 200), 0) << dt;
  }
}

TEST(DragAlong, TakesWhatTheMotionLosesAndNeverTurnsIt) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  const Vec3 n = Vec3(0.3, -0.2, 1).normalized();
  for (int k = 0; k < 200; ++k) {
    const Vec3 before(u(random), u(random), u(random));
    const Vec3 found = before + 0.3 * Vec3(u(random), u(random), u(random));
    const double rate = std::pow(10, 3 * u(random)), dt = std::pow(10, 2 * u(random));
    Vec3 v = found;
    const double lost = drag_along(
        n, before, dt,
        [&](double) {
          return SurfaceDrag{0, rate};
        },
        v.x(), v.y(), v.z());
    EXPECT_NEAR(v.dot(n), found.dot(n), 1e-14);
    EXPECT_NEAR(lost, 0.5 * (found - v).dot(before + v), 1e-13);
    const auto along = [&](const Vec3& w) { return Vec3(w - w.dot(n) * n); };
    // Without a pull it would only slow down.
    Vec3 still = before;
    const double taken = drag_along(
        n, before, dt,
        [&](double) {
          return SurfaceDrag{0, rate};
        },
        still.x(), still.y(), still.z());
    EXPECT_GE(taken, 0);
    EXPECT_GE(along(still).dot(along(before)), -1e-15);  // rounding of a stop
    EXPECT_LE(along(still).norm(), along(before).norm());
  }
}

TEST(WallShear, TheLayersBesideAWallBearTheTractionOfAnEvenShearTogether) {
  ContactSettings c;
  c.spacing = 0.1, c.smoothing_length = 0.13, c.reference_density = 1200;
  c.liquid = LiquidContact{{0, 0.5, 1}, LiquidBed::no_slip, {true}};
  const double shear = 7;  // 1/s
  double traction = 0;
  for (int k = 0; k < 6; ++k) {
    const double d = (k + 0.5) * c.spacing, v = shear * d;
    traction += c.reference_density * c.spacing * WallShear(c, d)(v).rate * v;
  }
  EXPECT_NEAR(traction, 0.5 * shear, 0.01 * 0.5 * shear);
}

/// A block of mud that collapses on a slope beside a wall.
test::LiquidBox mud(LiquidBed bed, int threads = 1) {
  test::LiquidBox box;
  box.spacing = 0.1;
  box.n = {14, 9, 7};
  box.slope = 0.2;
  box.along_slope = true;
  box.settings.law = {450, 60, 0.7};
  box.settings.sound_speed = 25;
  box.bed = bed;
  box.threads = threads;
  box.domain.walls.push_back({Vec3(-0.05, 0, 0), Vec3(1, 0, 0)});
  return box;
}

TEST(LiquidBed, LosesNoEnergyFromItsBooks) {
  for (const LiquidBed bed : {LiquidBed::slip, LiquidBed::film, LiquidBed::no_slip}) {
    test::HandMade made = test::liquid_of(mud(bed));
    while (made.state.time < 0.6) made.advance();
    const Ledger l = made.state.ledger();
    const double explained = l.kinetic_0 + l.gravity_work + l.stress_work + l.contact_work -
                             l.friction - l.rest_damping - l.lost_energy + l.outer_work;
    EXPECT_NEAR(l.kinetic, explained, 1e-4 * l.gravity_work);  // the half kick of the first step
    EXPECT_LT(std::abs(l.residual()), 0.01 * l.gravity_work);
    EXPECT_GT(l.numerical(), -0.02 * l.gravity_work);
    EXPECT_LT(l.numerical(), 0.1 * l.gravity_work);
    EXPECT_EQ(l.friction > 0, bed != LiquidBed::slip);
    EXPECT_GE(l.friction, (bed == LiquidBed::film ? 0.1 : 0) * l.gravity_work);
    EXPECT_EQ(l.leaked_mass, 0);
  }
}

/// What images in the ground push along it is the ground's; pairs alone give and take the same. A
/// wall's images are pairs, so there is none.
TEST(LiquidBed, PairsAloneKeepMomentum) {
  for (const LiquidBed bed : {LiquidBed::slip, LiquidBed::film, LiquidBed::no_slip}) {
    test::LiquidBox box = mud(bed);
    box.domain.walls.clear();
    test::HandMade made = test::liquid_of(box);
    while (made.state.time < 0.3) made.advance();
    const Ledger l = made.state.ledger();
    EXPECT_GT(l.stress_impulse_scale, 0);
    EXPECT_LT(l.stress_impulse.norm(), 1e-7 * l.stress_impulse_scale);
  }
}

TEST(LiquidBed, HoldsWhatItShould) {
  const auto front = [](LiquidBed bed) {
    test::HandMade made = test::liquid_of(mud(bed));
    while (made.state.time < 0.6) made.advance();
    const MovingSet& p = made.state.grains();
    return *std::max_element(p.x.begin(), p.x.end());
  };
  const double slips = front(LiquidBed::slip), held = front(LiquidBed::no_slip);
  EXPECT_LT(held, slips - 0.2);
  EXPECT_LT(front(LiquidBed::film), slips - 0.2);
}

TEST(LiquidBed, GivesTheSameBitsAtAnyNumberOfThreads) {
  for (const LiquidBed bed : {LiquidBed::film, LiquidBed::no_slip}) {
    test::HandMade one = test::liquid_of(mud(bed)), three = test::liquid_of(mud(bed, 3));
    for (int k = 0; k < 150; ++k) one.advance(), three.advance();
    const MovingSet &a = one.state.grains(), &b = three.state.grains();
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.vz, b.vz);
    EXPECT_EQ(a.ledger.friction, b.ledger.friction);
  }
}

/// Water between walls that drag: speed along them over that between walls that slip.
TEST(LiquidBed, WallsDragOnlyWhereTheyAreSaidTo) {
  const auto speed = [](bool hold) {
    test::LiquidBox box;
    box.spacing = 0.05;
    box.n = {8, 12, 4};
    box.half_width = 2;
    box.settings.law = {0, 5, 1};
    box.settings.sound_speed = 25;
    box.velocity = {0.5, 0, 0};
    box.walls_hold = hold;
    box.domain.x = {true, 0, 0.4, 0};
    box.domain.walls = {{Vec3(0, 0, 0), Vec3(0, 1, 0)}, {Vec3(0, 0.6, 0), Vec3(0, -1, 0)}};
    test::HandMade made = test::liquid_of(box);
    while (made.state.time < 2) made.advance();
    const MovingSet& p = made.state.grains();
    double sum = 0;
    for (const double v : p.vx) sum += v / static_cast<double>(p.size());
    return std::pair(sum, p.ledger.friction / p.ledger.kinetic_0);
  };
  const auto [slips, no_friction] = speed(false);
  EXPECT_NEAR(slips, 0.5, 1e-3);
  EXPECT_EQ(no_friction, 0);
  // Between plates nu pi^2/W^2 is the rate of the slowest mode, which has nearly all of it.
  const double nu = 5e-3, rate = nu * std::pow(3.141592653589793 / 0.6, 2);
  const auto [held, friction] = speed(true);
  EXPECT_NEAR(std::log(0.5 * 8 / std::pow(3.141592653589793, 2) / held) / (2 * rate), 1, 0.15);
  EXPECT_GT(friction, 0.1);
}

}  // namespace
}  // namespace sturz
