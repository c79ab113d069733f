// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/contact_impulse.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/vec.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace sturz {
namespace {

/// A velocity, the contact's plane and what acts: one call of the law.
struct Touch {
  ContactLaw law;
  Vec3 normal{0, 0, 1};
  Vec3 before{0, 0, 0};
  Vec3 velocity{0, 0, 0};
  double distance = 0.5, pressure = 0, dt = 1e-3;
  ContactEnergy energy;

  Vec3 apply() {
    energy = apply_contact(law, distance, normal.x(), normal.y(), normal.z(), pressure, dt,
                           before.data(), velocity.x(), velocity.y(), velocity.z());
    return velocity;
  }
};

Vec3 tangential(const Vec3& v, const Vec3& n) { return v - v.dot(n) * n; }

Touch random_touch(std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1, 1);
  Touch t;
  t.law = {4e3, 20, 0.5, 0.8 * std::abs(u(random)), 30 * std::abs(u(random)), 1};
  t.normal = Vec3(u(random), u(random), 1.2).normalized();
  t.before = 4 * Vec3(u(random), u(random), u(random));
  t.velocity = t.before + 0.2 * Vec3(u(random), u(random), u(random));
  t.distance = 0.3 + 0.6 * u(random);
  t.pressure = u(random) > 0 ? 40 * std::abs(u(random)) : 0;
  return t;
}

TEST(ContactImpulse, StickingIsExact) {
  // A slope of 20 degrees under tan 25: gravity's share of one step never moves the particle.
  const double slope = 0.349, g = standard_gravity, dt = 1e-3;
  Touch t;
  t.law.friction = 0.466;
  t.normal = {std::sin(slope), 0, std::cos(slope)};
  t.pressure = g * std::cos(slope);
  t.dt = dt;
  for (int n = 0; n < 1000; ++n) {
    t.before = t.velocity;
    t.velocity += Vec3(0, 0, -g * dt);
    t.apply();
    EXPECT_NEAR(t.velocity.norm(), 0, 1e-16);
    EXPECT_NEAR(t.energy.friction, 0, 1e-18);
    t.velocity.setZero();
  }
}

TEST(ContactImpulse, SlidingDeceleratesByTheFrictionCoefficient) {
  Touch t;
  t.law.friction = 0.3;
  t.velocity = {2, 0, 0};
  t.pressure = 9.81;
  EXPECT_NEAR(t.apply().x(), 2 - 0.3 * 9.81 * 1e-3, 1e-15);
}

TEST(ContactImpulse, FrictionNeverTurnsAParticleRound) {
  std::mt19937 random(5);
  for (int n = 0; n < 5000; ++n) {
    Touch t = random_touch(random);
    t.law.friction *= n % 5 ? 1 : 1e6;
    const Vec3 slip = tangential(t.velocity, t.normal);
    const Vec3 left = tangential(t.apply(), t.normal);
    ASSERT_GE(left.dot(slip), -1e-12);
    ASSERT_LE(left.norm(), slip.norm() * (1 + 1e-12));
    ASSERT_LE(left.cross(slip).norm(), 1e-12 * slip.squaredNorm() + 1e-15);
  }
}

/// Loss of tangential speed over gain of normal speed: the friction that was really accounted.
double accounted_friction(Touch t) {
  const Vec3 before = t.velocity;
  const Vec3 after = t.apply();
  return (tangential(before, t.normal).norm() - tangential(after, t.normal).norm()) /
         (after - before).dot(t.normal);
}

TEST(ContactImpulse, EveryNormalImpulseEntersTheCoulombCap) {
  Touch named;
  named.law = {1000, 5, 0.5, 0.4, 0, -1};
  named.normal = Vec3(0.3, -0.2, 1).normalized();
  named.velocity = {30, 10, 0};
  Touch spring = named;
  spring.distance = 0.2;
  EXPECT_NEAR(accounted_friction(spring), 0.4, 1e-9);
  Touch pressure = named;
  pressure.pressure = 300;
  EXPECT_NEAR(accounted_friction(pressure), 0.4, 1e-9);
  Touch both = spring;
  both.pressure = 300;
  EXPECT_NEAR(accounted_friction(both), 0.4, 1e-9);
  // The guard: a centre under the ground that still sinks is stopped, which is an impulse too.
  Touch guard = named;
  guard.distance = -1e-9;
  guard.law.stiffness = 1e-6;
  guard.law.damping = 0;
  guard.velocity = tangential(guard.velocity, guard.normal) - 4 * guard.normal;
  Touch stopped = guard;
  EXPECT_NEAR(stopped.apply().dot(guard.normal), 0, 1e-12);
  EXPECT_NEAR(accounted_friction(guard), 0.4, 1e-9);
}

TEST(ContactImpulse, SpringNeverPulls) {
  Touch t;
  t.law = {100, 50, 0.5, 0, 0, -1};
  t.distance = 0.49;
  t.velocity = {0, 0, 3};  // leaves so fast that the damper would hold it back
  EXPECT_EQ(t.apply().z(), 3);
}

TEST(ContactImpulse, BeyondTheContactDistanceNothingHappens) {
  Touch t;
  t.law = {100, 5, 0.5, 0.6, 10, 1};
  t.distance = 1.0;
  t.velocity = {1, 2, -3};
  EXPECT_EQ(t.apply(), Vec3(1, 2, -3));
}

/// Rebound speed over impact speed of a free particle on a flat bed.
double rebound(double restitution, double speed) {
  Touch t;
  const double k = 1e4;
  t.law = {k, 2 * damping_ratio(restitution) * std::sqrt(k), 0.5, 0, 0, -1};
  t.dt = 0.01 / std::sqrt(k);
  double z = 0.5;
  t.velocity = {0, 0, -speed};
  do {
    t.distance = z;
    t.apply();
    z += t.dt * t.velocity.z();
  } while (z < 0.5);
  return t.velocity.z() / speed;
}

/// The spring never pulls, so the last stretch of the damped bounce is cut off and the rebound lies
/// above the value set: exp(-zeta/w (pi - atan(2 zeta w/(1 - 2 zeta^2)))), w = sqrt(1 - zeta^2),
/// Schwager and Poeschel (2007).
double rebound_without_pull(double restitution) {
  const double zeta = damping_ratio(restitution), w = std::sqrt(1 - zeta * zeta);
  return std::exp(-zeta / w * (std::numbers::pi - std::atan2(2 * zeta * w, 1 - 2 * zeta * zeta)));
}

TEST(ContactImpulse, DampingGivesTheRestitution) {
  for (double e : {1.0, 0.9, 0.7, 0.5, 0.2})
    for (double speed : {0.1, 1.0})
      EXPECT_NEAR(rebound(e, speed), rebound_without_pull(e), 5e-3) << e;
  EXPECT_NEAR(rebound_without_pull(0.9), 0.902, 5e-4);
  EXPECT_NEAR(rebound_without_pull(0.2), 0.325, 1e-3);
  EXPECT_EQ(damping_ratio(1), 0);
  EXPECT_NEAR(damping_ratio(1e-9), damping_ratio(0), 1e-12);
  EXPECT_LT(damping_ratio(0), 1);
}

TEST(ContactImpulse, CohesionBrakesOnlyNearTheGround) {
  Touch near;
  near.law = {100, 0, 0.5, 0, 20, 1};
  near.distance = 0.9;
  near.velocity = {1, 0, 0};
  Touch far = near;
  far.distance = 1.1;
  EXPECT_NEAR(near.apply().x(), 1 - 20e-3, 1e-15);
  EXPECT_EQ(far.apply().x(), 1);
  near.velocity = {0.01, 0, 0};
  EXPECT_EQ(near.apply().x(), 0);  // less than cohesion takes in a step
}

TEST(ContactImpulse, WorksAddUpToTheChangeOfKineticEnergy) {
  std::mt19937 random(11);
  for (int n = 0; n < 5000; ++n) {
    Touch t = random_touch(random);
    const Vec3 kicked = t.velocity;
    const Vec3 after = t.apply();
    const double kick_work = (kicked - t.before).dot(0.5 * (t.before + after));
    const double change = 0.5 * (after.squaredNorm() - t.before.squaredNorm());
    const double accounted =
        kick_work + t.energy.pressure_work + t.energy.contact_work - t.energy.friction;
    ASSERT_NEAR(accounted, change, 1e-12 * (1 + std::abs(change)));
    ASSERT_GE(t.energy.spring, 0);
  }
}

}  // namespace
}  // namespace sturz
