// SPDX-License-Identifier: Apache-2.0
/// Isolated particles in flight that hit each other and the ground: what is kept, what is lost.
#include "engine/effects/isolated/contacts.hpp"
#include "tests/support/isolated_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace sturz {
namespace {

using test::bag;
using test::Flight;
using test::free_flight;
using test::Scene;
using test::Thrown;

TEST(IsolatedContacts, TwoIsolatedParticlesKeepTheirMomentumAndTheLedgerCloses) {
  // Unlike sizes, off centre: they slide, spin and part.
  Flight f({{{-1, 0, 100}, {6, 1, 0}, 0.5}, {{1, 0.3, 100.2}, {-5, 0, 0.5}, 0.8}}, free_flight());
  const Vec3 momentum = f.momentum(), angular = f.angular_momentum();
  const double kinetic = f.state.grains().ledger.kinetic, scale = f.state.grains().mass[1] * 6;
  for (int n = 0; n < 60; ++n) {
    f.advance(0.005);
    ASSERT_LT((f.momentum() - momentum).norm(), 1e-12 * scale);
    ASSERT_LT((f.angular_momentum() - angular).norm(), 1e-12 * 100 * scale);
    ASSERT_LT(std::abs(f.state.grains().ledger.residual()), 1e-12 * kinetic);
  }
  const Ledger& ledger = f.state.grains().ledger;
  EXPECT_GT((f.position(1) - f.position(0)).norm(), 1.3 + 0.1);
  EXPECT_GT(f.spin(0).norm(), 1);
  EXPECT_GT(ledger.rotational, 0);
  EXPECT_EQ(ledger.isolated_elastic, 0);
  EXPECT_GT(ledger.isolated_dissipated(), 0.1 * kinetic);
  EXPECT_EQ(ledger.contact_work, ledger.isolated_work);
  EXPECT_EQ(ledger.damping(), 0);
  EXPECT_NEAR(ledger.kinetic + ledger.rotational + ledger.isolated_dissipated(), kinetic,
              1e-12 * kinetic);
}

/// Relative speed after over before of two equal particles that meet head on.
double head_on(double restitution, double v, double dt, bool never_pulls = false) {
  Scene scene = free_flight(restitution, 0);
  scene.contacts.never_pulls = never_pulls;
  Flight f({{{-0.6, 0, 100}, {v, 0, 0}}, {{0.6, 0, 100}, {-v, 0, 0}}}, scene);
  for (double t = 0; t < 1.5 / v; t += dt) f.advance(dt);
  EXPECT_LT(f.velocity(0).x(), 0);
  return (f.velocity(1).x() - f.velocity(0).x()) / (2 * v);
}

TEST(IsolatedContacts, RestitutionIsTheOneThatWasSetAtItsOwnFineStep) {
  for (double e : {0.3, 0.5, 0.7, 0.9, 1.0})
    for (double v : {0.5, 10.0})
      EXPECT_NEAR(head_on(e, v, 0.02 / v), e, 0.01) << "at " << v << " m/s";
  EXPECT_NEAR(head_on(0.5, 10, 0.002, true), 0.55, 0.01);
}

TEST(IsolatedContacts, TheStepOfTheRestDoesNotMatter) {
  // Within what t_c/20 leaves open: where in a fine step the two touch first.
  const double reference = head_on(0.7, 10, 1e-4);
  for (double dt : {3e-4, 1e-3, 3e-3, 1e-2, 3e-2})
    EXPECT_NEAR(head_on(0.7, 10, dt), reference, 0.01);
}

TEST(IsolatedContacts, ArriveWhereTheFineStepsEnded) {
  // The drift of one long step takes them round the impact: they do not pass through each other.
  const std::vector<Thrown> two{{{-0.6, 0, 100}, {10, 0, 0}}, {{0.6, 0.2, 100}, {-10, 0, 0}}};
  Flight once(two, free_flight()), often(two, free_flight());
  once.advance(0.05);
  for (int n = 0; n < 100; ++n) often.advance(0.0005);
  EXPECT_GT((once.position(1) - once.position(0)).norm(), 1);
  EXPECT_GT(once.spin(0).norm(), 1);
  // What steps of t_c/20 leave open, see IsolatedBodies.FineStepsConverge; they meet at 20 m/s.
  for (std::size_t i : {0u, 1u}) {
    EXPECT_LT((once.velocity(i) - often.velocity(i)).norm(), 0.01 * 20);
    EXPECT_LT(0.5 * (once.spin(i) - often.spin(i)).norm(), 0.02 * 20);
    EXPECT_LT((once.position(i) - often.position(i)).norm(), 0.01 * 20 * 0.05);
  }
}

TEST(IsolatedContacts, ABagKeepsMomentumAndNeverGainsEnergy) {
  for (double dt : {0.002, 0.02}) {  // 0.02: they fly a radius per step
    Flight f(bag(50, 15), free_flight());
    const Vec3 momentum = f.momentum();
    const double start = f.state.grains().ledger.kinetic;
    double scale = 0, last = start, pairs = 0;
    for (double m : f.state.grains().mass) scale += m * 20;
    for (double t = 0; t < 1; t += dt) {
      f.advance(dt);
      ASSERT_LT((f.momentum() - momentum).norm(), 1e-12 * scale);
      ASSERT_LE(f.energy(), last + 1e-9 * start) << "at " << t;
      ASSERT_LT(std::abs(f.state.grains().ledger.residual()), 1e-11 * start);
      last = std::min(last, f.energy());
      pairs = std::max(pairs, f.state.grains().ledger.isolated_elastic);
    }
    EXPECT_GT(pairs, 0);
    EXPECT_LT(f.energy(), 0.6 * start);
    EXPECT_GT(f.state.grains().ledger.isolated_dissipated(), 0.4 * start);
  }
}

TEST(IsolatedContacts, FasterThanTheBoundTheyOverlapMoreButGainNothing) {
  Scene scene = free_flight();
  scene.contacts.speed_bound = 4;  // they meet at up to 40
  Flight f(bag(50, 15), scene);
  const double start = f.state.grains().ledger.kinetic;
  for (int n = 0; n < 50; ++n) {
    const double before = f.energy();
    f.advance(0.02);
    ASSERT_LE(f.energy(), before + 1e-6 * start) << n;
  }
  EXPECT_LT(f.energy(), 0.6 * start);
}

TEST(IsolatedContacts, WithoutLossesABagKeepsItsEnergy) {
  Flight f(bag(50, 15), free_flight(1, 0));
  const double start = f.state.grains().ledger.kinetic;
  for (int n = 0; n < 200; ++n) {
    f.advance(0.004);
    ASSERT_NEAR(f.energy(), start, 0.01 * start) << n;
  }
  EXPECT_GT((f.velocity(0) - Flight(bag(50, 15), free_flight(1, 0)).velocity(0)).norm(), 1);
}

TEST(IsolatedContacts, GiveTheSameBitsAgainAndInAnyStorageOrder) {
  Flight f(bag(50, 15), free_flight()), g(bag(50, 15), free_flight()),
      h(bag(50, 15), free_flight());
  std::vector<std::uint32_t> order(50);
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  h.state.grains().permute(order);
  h.state.threads = 2;
  for (int n = 0; n < 60; ++n) {
    for (Flight* each : {&f, &g, &h}) each->advance(0.004);
    if (n % 20 != 0) continue;
    std::shuffle(order.begin(), order.end(), std::mt19937(n));
    h.state.grains().permute(order);
  }
  ASSERT_LT(f.energy(), 0.8 * f.state.grains().ledger.kinetic_0);
  for (std::size_t k = 0; k < 50; ++k) {
    const std::uint32_t i = h.state.grains().id[k];
    EXPECT_EQ(f.position(i), g.position(i));
    EXPECT_EQ(f.spin(i), g.spin(i));
    EXPECT_EQ(f.position(i), h.position(k));
    EXPECT_EQ(f.velocity(i), h.velocity(k));
    EXPECT_EQ(f.spin(i), h.spin(k));
  }
}

TEST(IsolatedContacts, ParticlesOutOfContactAreNotTouched) {
  // Bit by bit the flight without the pass: no particle is stepped finely, nothing is accounted.
  Flight f({{{-5, 0, 100}, {3, 1, 0}}, {{0.3, 0.1, 101}, {3, 1, 0}}, {{9, 0, 99}, {-0.1, 0, 0}}},
           free_flight());
  std::vector<Vec3> x{f.position(0), f.position(1), f.position(2)};
  for (int n = 0; n < 50; ++n) {
    f.advance(0.01);
    for (std::size_t i = 0; i < 3; ++i) {
      for (int c = 0; c < 3; ++c) x[i][c] += 0.01 * f.velocity(i)[c];
      ASSERT_EQ(f.position(i), x[i]);
    }
  }
  EXPECT_EQ(f.state.grains().ledger.isolated_work, 0);
  EXPECT_EQ(f.velocity(0), Vec3(3, 1, 0));
}

TEST(IsolatedContacts, OnlyTheGroupThatTouchesIsStepped) {
  // A far particle keeps its bits while two others collide.
  const Thrown far{{30, 0.1, 100.7}, {0.3, 0.7, 0.1}};
  Flight f({{{-0.6, 0, 100}, {10, 0, 0}}, {{0.6, 0, 100}, {-10, 0, 0}}, far}, free_flight());
  Vec3 x = far.position;
  for (int n = 0; n < 10; ++n) {
    f.advance(0.007);
    for (int c = 0; c < 3; ++c) x[c] += 0.007 * far.velocity[c];
    ASSERT_EQ(f.position(2), x);
  }
  EXPECT_LT(f.velocity(0).x(), 0);
}

TEST(IsolatedContacts, GrainsOfTheContinuumAreNotIsolated) {
  Flight f({{{-0.6, 0, 100}, {10, 0, 0}}, {{0.6, 0, 100}, {-10, 0, 0}}}, free_flight());
  f.state.grains().n_listed = 1;
  for (int n = 0; n < 30; ++n) f.advance(0.005);
  EXPECT_EQ(f.velocity(0), Vec3(10, 0, 0));
  EXPECT_EQ(f.velocity(1), Vec3(-10, 0, 0));
}

TEST(IsolatedContacts, BecomingIsolatedSetsNoEnergyFree) {
  // Half a radius into each other, as neighbours in the continuum may be.
  Flight rest({{{0, 0, 100}, {0, 0, 0}}, {{0.75, 0, 100}, {0, 0, 0}}}, free_flight());
  for (int n = 0; n < 20; ++n) rest.advance(0.01);
  EXPECT_EQ(rest.velocity(0), Vec3(0, 0, 0));
  EXPECT_EQ(rest.position(1), Vec3(0.75, 0, 100));

  // Flying into each other they bounce from where they are, and later from their full radius.
  Flight meet({{{0, 0, 100}, {2, 0, 0}}, {{0.75, 0, 100}, {-2, 0, 0}}}, free_flight(0.7));
  for (int n = 0; n < 100; ++n) {
    meet.advance(0.002);
    ASSERT_LE(meet.energy(), meet.state.grains().ledger.kinetic_0 * (1 + 1e-3));
  }
  EXPECT_NEAR(meet.velocity(1).x(), 1.4, 0.03);
  EXPECT_EQ(meet.spin(0).norm(), 0);

  // Separating without load, then pushed together again: the zero has moved out with them.
  Flight part({{{0, 0, 100}, {-1, 0, 0}}, {{0.75, 0, 100}, {1, 0, 0}}}, free_flight(0.7));
  for (int n = 0; n < 10; ++n) part.advance(0.01);
  EXPECT_EQ(part.velocity(1), Vec3(1, 0, 0));
  const double gap = part.position(1).x() - part.position(0).x();
  ASSERT_LT(gap, 1);
  part.state.grains().vx = {1, -1};
  double nearest = gap;
  for (int n = 0; n < 40; ++n) {
    part.advance(0.01);
    nearest = std::min(nearest, part.position(1).x() - part.position(0).x());
  }
  EXPECT_GT(nearest, gap - 0.03);
  EXPECT_NEAR(part.velocity(1).x(), 0.7, 0.02);
}

TEST(IsolatedContacts, ANewIsolatedParticleHasNoSpin) {
  Flight f({{{-0.6, 0, 100}, {10, 0, 0}}, {{0.6, 0.5, 100}, {-10, 0, 0}}}, free_flight());
  for (int n = 0; n < 30; ++n) f.advance(0.005);
  ASSERT_GT(f.spin(0).norm(), 1);
  f.state.grains().n_listed = 2;
  f.advance(0.005);
  EXPECT_EQ(f.state.grains().ledger.rotational, 0);
  f.state.grains().n_listed = 0;
  f.advance(0.005);
  EXPECT_EQ(f.spin(0), Vec3(0, 0, 0));
  EXPECT_EQ(f.state.grains().ledger.rotational, 0);
}

TEST(IsolatedContacts, MeetAcrossAPeriod) {
  Scene scene = free_flight(1, 0);
  scene.domain.x = {true, -4, 4, 0.5};
  Flight f({{{3.5, 0, 100.5}, {5, 0, 0}}, {{-3.2, 0, 100}, {-5, 0, 0}}}, scene);
  for (int n = 0; n < 20; ++n) f.advance(0.005);
  EXPECT_NEAR(f.velocity(0).x(), -5, 0.05);
  EXPECT_NEAR(f.velocity(1).x(), 5, 0.05);
  EXPECT_NEAR(f.velocity(1).z(), 0, 1e-9);
}

TEST(IsolatedContacts, KineticEnergyChangesOnlyByAccountedWorksUnderGravity) {
  Scene scene = free_flight();
  scene.gravity = 9.81;
  scene.works = true;
  Flight f(bag(50, 15), scene);
  const Ledger& ledger = f.state.grains().ledger;
  f.advance(1e-12);  // the first kick takes half a step only
  for (int n = 0; n < 200; ++n) {
    f.advance(0.004);
    ASSERT_NEAR(ledger.kinetic - ledger.kinetic_0, ledger.gravity_work + ledger.contact_work,
                1e-10 * ledger.kinetic_0)
        << n;
  }
  // What is left is where within a step a hit falls: gravity's work over the displacement of half a
  // step.
  EXPECT_GT(ledger.isolated_dissipated(), 0.3 * ledger.kinetic_0);
  EXPECT_LT(std::abs(ledger.residual()), 0.005 * ledger.kinetic_0);
}

TEST(IsolatedContacts, BounceFromTheGroundAsItsRestitutionSays) {
  Scene scene = free_flight();
  scene.ground = true;
  scene.contacts.on_ground = true;
  scene.contacts.ground_restitution = 0.9;
  scene.contacts.ground_friction = 0.3;
  const double v = 6;
  Flight f({{{0.3, 0.2, 1.5}, {0, 0, -v}}, {{5, 5, 1.5}, {20, 0, -v}}}, scene);
  for (int n = 0; n < 60; ++n) f.advance(0.005);
  EXPECT_NEAR(f.velocity(0).z(), 0.9 * v, 0.01 * v);
  EXPECT_EQ(f.spin(0).norm(), 0);
  // Gross sliding: tan psi = 3.3 > 3.5 mu (1 + e) = 2.0 (V12b).
  const double gain = -0.3 * 1.9 * v;
  EXPECT_NEAR(f.velocity(1).x() - 20, gain, 0.03 * std::abs(gain));
  EXPECT_NEAR(f.spin(1).y(), -2.5 * gain / 0.5, 0.03 * 2.5 * std::abs(gain) / 0.5);
  EXPECT_GT(f.state.grains().ledger.isolated_dissipated(), 0);
}

TEST(IsolatedContacts, ASlidingParticleIsSlowedByCoulombFrictionAlone) {
  // Every step looks at the contact anew: the damper of a contact that sticks must not add to it.
  for (const double friction : {0.0, 0.2}) {
    Scene scene = free_flight();
    scene.gravity = 9.81;
    scene.ground = true;
    scene.contacts.on_ground = true;
    scene.contacts.ground_friction = friction;
    scene.contacts.speed_bound = 8;
    Flight f({{{-8, 0.2, 0.5}, {5, 0, 0}}}, scene);
    for (int n = 0; n < 60; ++n) f.advance(0.005);
    EXPECT_NEAR(5 - f.velocity(0).x(), friction * 9.81 * 0.3, 0.02 * friction * 9.81 * 0.3);
    const double spin = 2.5 * (5 - f.velocity(0).x()) / 0.5;  // the arm is the overlap shorter
    EXPECT_NEAR(f.spin(0).y(), spin, 2e-3 * spin);
  }
}

TEST(IsolatedContacts, ASlidingParticleEndsUpRolling) {
  Scene scene = free_flight();
  scene.gravity = 9.81;
  scene.ground = true;
  scene.contacts.on_ground = true;
  scene.contacts.speed_bound = 8;
  Flight f({{{-8, 0.2, 0.5}, {5, 0, 0}}}, scene);
  for (int n = 0; n < 300; ++n) f.advance(0.005);
  const double rolling = 5.0 * 5 / 7;
  EXPECT_NEAR(f.velocity(0).x(), rolling, 0.01 * rolling);
  EXPECT_NEAR(f.spin(0).y() * 0.5, rolling, 0.01 * rolling);
  EXPECT_NEAR(f.position(0).z(), 0.5, 0.01);
  EXPECT_NEAR(f.state.grains().ledger.isolated_dissipated(),
              2.0 / 7 * f.state.grains().ledger.kinetic_0,
              0.02 * f.state.grains().ledger.kinetic_0);
}

}  // namespace
}  // namespace sturz
