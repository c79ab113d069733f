// SPDX-License-Identifier: Apache-2.0
/// One or two grains against closed forms: restitution, sliding, rolling, rest.
#include "engine/core/constants.hpp"
#include "tests/support/discrete_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sturz {
namespace {

using test::GrainRun;
using test::GrainScene;
using test::SetDown;

constexpr double g = standard_gravity;

double impact_time(const GrainScene& scene, double speed) {
  return 20 * grain_time_step(scene.grains, speed);
}

/// Root mean square of what the restitution of two equal grains that meet head on misses, over
/// where in a step they touch first. \param n  steps per impact
double restitution_error(double restitution, int n) {
  GrainScene scene;
  scene.gravity = 0;
  scene.grains.restitution = restitution;
  const double v = 2, tc = impact_time(scene, 2 * v), dt = tc / n;
  double sum = 0;
  constexpr int phases = 8;
  for (int k = 0; k < phases; ++k) {
    const double gap = 0.05 + 2 * v * dt * k / phases;
    GrainRun run(
        {{{0, 0, 10}, {v, 0, 0}, {0, 0, 0}, 0.5}, {{1 + gap, 0, 10}, {-v, 0, 0}, {0, 0, 0}, 0.5}},
        scene);
    run.run(0.05 / (2 * v) + 6 * tc, dt);
    EXPECT_GT((run.position(1) - run.position(0)).norm(), 1);
    const double e = (run.velocity(1).x() - run.velocity(0).x()) / (2 * v);
    sum += (e - restitution) * (e - restitution);
  }
  return std::sqrt(sum / phases);
}

TEST(GrainContacts, TwoGrainsPartWithTheRestitutionThatWasSet) {
  for (const double e : {0.3, 0.5, 0.9}) {
    const double coarse = restitution_error(e, 20), middle = restitution_error(e, 40),
                 fine = restitution_error(e, 80);
    EXPECT_LT(coarse, 0.01) << e;  // at the step of the effect itself
    const double order = 0.5 * std::log2(coarse / fine);
    RecordProperty("order_of_restitution_" + std::to_string(static_cast<int>(10 * e)),
                   std::to_string(order));
    // The damper sets in with (v t)^(1/4) somewhere within a step: order 5/4, not 2.
    EXPECT_GT(order, 1) << e << ": " << coarse << " " << middle << " " << fine;
  }
}

/// What the weight of a grain of this radius presses it into the slope, along the normal.
double pressed(const GrainScene& scene, double radius) {
  const GrainMaterial& m = scene.grains.material;
  const double cosine = 1 / std::sqrt(1 + scene.slope * scene.slope);
  const double mass = 4.0 / 3 * std::numbers::pi * m.density * std::pow(radius, 3);
  return std::pow(mass * g * cosine / (4.0 / 3 * contact_modulus(m, m) * std::sqrt(radius)),
                  2.0 / 3);
}

/// Radius over the arm at which a pressed grain rolls: its centre is nearer to the ground.
double radius_over_arm(const GrainScene& scene) { return 0.5 / (0.5 - pressed(scene, 0.5)); }

/// Acceleration down a slope over two seconds from rest, by the way that was made.
double acceleration(const GrainScene& scene, double dt) {
  // It starts as it just touches.
  const double x = -20, z = -scene.slope * x + 0.5 * std::sqrt(1 + scene.slope * scene.slope);
  GrainRun run({{{x, 0, z}}}, scene);
  run.run(0.5, dt);
  const Vec3 v0 = run.velocity(0);
  run.run(2, dt);
  return (run.velocity(0) - v0).norm() / 1.5;
}

TEST(GrainContacts, AGrainSlidesDownASteepSlopeAsCoulombHasIt) {
  GrainScene scene;
  scene.slope = std::tan(std::numbers::pi / 6);
  const double friction = 0.1;  // under 2/7 tan: it does not roll
  scene.grains.bed[0].friction_coefficient = friction;
  const double wanted = g * (0.5 - friction * std::sqrt(3.0) / 2);
  double last = 1;
  for (const double dt : {4e-3, 2e-3, 1e-3}) {
    const double error = std::abs(acceleration(scene, dt) / wanted - 1);
    EXPECT_LT(error, 2e-3) << dt;
    last = error;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(GrainContacts, ARoughSlopeMakesItRoll) {
  GrainScene scene;
  scene.slope = std::tan(std::numbers::pi / 6);
  scene.grains.bed[0].friction_coefficient = 0.6;
  for (const double rolling : {0.0, 0.2}) {
    scene.grains.bed_rolling_friction = rolling;
    const double r = radius_over_arm(scene);
    const double wanted = g * (0.5 - r * rolling * std::sqrt(3.0) / 2) / (1 + 0.4 * r * r);
    for (const double dt : {4e-3, 2e-3, 1e-3})
      EXPECT_NEAR(acceleration(scene, dt) / wanted, 1, 2e-3) << rolling << " " << dt;
  }
}

TEST(GrainContacts, RollingFrictionHoldsItWhereTheSlopeIsGentler) {
  GrainScene scene;
  scene.slope = 0.4;
  scene.grains.bed[0].friction_coefficient = 0.6;
  scene.grains.bed_rolling_friction = 0.45;
  EXPECT_LT(acceleration(scene, 2e-3), 1e-3);
  // By default the bed's own coefficient, less what pore pressure takes.
  scene.grains.bed_rolling_friction.reset();
  EXPECT_LT(acceleration(scene, 2e-3), 1e-3);
  scene.grains.bed[0].pore_pressure_ratio = 0.5;
  EXPECT_GT(acceleration(scene, 2e-3), 0.5);
}

TEST(GrainContacts, AThrownGrainEndsWithFiveSeventhsOfItsSpeed) {
  GrainScene scene;
  scene.grains.bed[0].friction_coefficient = 0.3;
  const double r = radius_over_arm(scene), v0 = 3, rolls = v0 / (1 + 0.4 * r * r);
  EXPECT_NEAR(rolls, 5 * v0 / 7, 0.01 * v0);
  const double slides = (v0 - rolls) / (0.3 * g);
  for (const double dt : {4e-3, 2e-3, 1e-3}) {
    GrainRun run({{{-10, 0, 0.5}, {v0, 0, 0}}}, scene);
    run.run(0.5 * slides, dt);
    EXPECT_NEAR(run.velocity(0).x(), 0.5 * (v0 + rolls), 0.02 * v0) << dt;
    run.run(2 * slides, dt);
    EXPECT_NEAR(run.velocity(0).x(), rolls, 1e-3 * v0) << dt;
    EXPECT_NEAR(run.spin(0).y() * 0.5 / r, rolls, 2e-3 * v0) << dt;
    const double lost = 0.5 * run.grains().mass[0] * v0 * (v0 - rolls);
    EXPECT_NEAR(run.ledger().friction, lost, 0.01 * lost) << dt;
  }
}

TEST(GrainContacts, CohesionOfTheBedHoldsWhatFrictionWouldNot) {
  GrainScene scene;
  scene.slope = 0.4;
  scene.grains.bed[0].friction_coefficient = 0.1;
  scene.grains.bed_rolling_friction = 1;
  EXPECT_GT(acceleration(scene, 2e-3), 1);
  scene.grains.bed[0].cohesion_pa = 2e4;  // times pi R^2: 1.3 times the weight
  EXPECT_LT(acceleration(scene, 2e-3), 1e-3);
}

TEST(GrainContacts, AStackBetweenWallsStaysAsDeepAsItsWeightPressesIt) {
  GrainScene scene;
  scene.domain.walls = {{{-0.5, 0, 0}, {1, 0, 0}, 0},
                        {{0.5, 0, 0}, {-1, 0, 0}, 0},
                        {{0, -0.5, 0}, {0, 1, 0}, 0},
                        {{0, 0.5, 0}, {0, -1, 0}, 0}};
  GrainRun run({{{0, 0, 0.5}}, {{0, 0, 1.5}}, {{0, 0, 2.5}}}, scene);
  run.run(8, 2e-3);
  const GrainMaterial& m = scene.grains.material;
  const double modulus = contact_modulus(m, m), weight = run.grains().mass[0] * g;
  const auto overlap = [&](double load, double radius) {
    return std::pow(load / (4.0 / 3 * modulus * std::sqrt(radius)), 2.0 / 3);
  };
  double top = 0.5 - overlap(3 * weight, 0.5);
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0) top += 1 - overlap((3.0 - static_cast<double>(i)) * weight, 0.25);
    EXPECT_NEAR(run.position(i).z(), top, 1e-5) << i;
    EXPECT_LT(run.velocity(i).norm(), 1e-5) << i;
  }
  EXPECT_LT(std::abs(run.ledger().numerical()), 1e-2 * run.ledger().collisions);
}

}  // namespace
}  // namespace sturz
