// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/mu_i_rheology.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace sturz {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Glass beads as in docs/physics.md A.3: mu_s = tan 20.9, mu_2 = tan 32.76 degrees.
MuIRheology beads() {
  MuIRheology law;
  law.static_friction = std::tan(20.9 * degree);
  law.dynamic_friction = std::tan(32.76 * degree);
  law.inertial_number_scale = 0.279;
  law.grain_diameter = 0.01;
  law.grain_density = 2600;
  return law;
}

double slowness(const MuIRheology& law, double shear_modulus, double dt) {
  return shear_modulus * dt * law.inertial_number_scale /
         (law.grain_diameter * std::sqrt(law.grain_density));
}

/// Shear stress after steady simple shear at constant pressure, long enough to have yielded.
double sheared(const MuIRheology& law, double rate, double pressure, double dt) {
  const double shear_modulus = 5e6;
  const double a = slowness(law, shear_modulus, dt);
  const double steps = 6 * law.dynamic_friction * pressure / (shear_modulus * rate * dt) + 20;
  double tau = 0;
  for (int n = 0; n < steps; ++n)
    tau = yield_return(law, tau + shear_modulus * rate * dt, pressure, a);
  return tau;
}

TEST(MuIRheology, SteadyShearStressDoesNotDependOnTheTimeStep) {
  const struct {
    double rate, tau;
  } published[] = {{0.1, 1912.686}, {1, 1942.270}, {10, 2177.956}, {100, 2852.442}};
  const MuIRheology law = beads();
  for (const auto& [rate, tau] : published) {
    const double number = rate * law.grain_diameter / std::sqrt(5e3 / law.grain_density);
    EXPECT_NEAR(5e3 * friction_at(law, number), tau, 6e-4) << rate;
    // At the slowest rate the smallest step takes tens of thousands of steps to reach yield.
    for (double dt : {1e-6, 1e-4, 1e-2}) {
      if (rate * dt < 1e-7 + 1e-12) {
        double at = tau - 1;  // start just below, to save the way there
        const double g = 5e6, a = slowness(law, g, dt);
        for (int n = 0; n < 40000; ++n) at = yield_return(law, at + g * rate * dt, 5e3, a);
        EXPECT_NEAR(at, tau, 6e-4) << rate << " at dt " << dt;
      } else {
        EXPECT_NEAR(sheared(law, rate, 5e3, dt), tau, 6e-4) << rate << " at dt " << dt;
      }
    }
  }
}

TEST(MuIRheology, ElasticTrialsPassUntouched) {
  const MuIRheology law = beads();
  for (double share : {0.0, 0.3, 1.0})
    EXPECT_EQ(yield_return(law, share * law.static_friction * 800, 800, 7),
              share * law.static_friction * 800);
}

TEST(MuIRheology, WithoutPressureOnlyCohesionHolds) {
  MuIRheology law = beads();
  EXPECT_EQ(yield_return(law, 1e6, 0, 50), 0);
  EXPECT_LT(yield_return(law, 1e6, 1e-12, 50), 1e-11);
  law.cohesion = 5000;
  EXPECT_DOUBLE_EQ(yield_return(law, 1e6, 0, 50), 5000);
  EXPECT_EQ(yield_return(law, 4000, 0, 50), 4000);
  EXPECT_NEAR(yield_return(law, 1e6, 1e-9, 50), 5000, 1e-5);
}

TEST(MuIRheology, EqualFrictionsGiveCoulombYield) {
  MuIRheology law = beads();
  law.dynamic_friction = law.static_friction = 0.5;
  law.cohesion = 100;
  for (double dt : {1e-9, 1e-5, 1.0, 1e6})
    for (double trial : {1101.0, 5e3, 1e9}) {
      const double tau = yield_return(law, trial, 2000, slowness(law, 5e6, dt));
      EXPECT_NEAR(tau, 1100, 1e-9 * 1100) << dt << " " << trial;
    }
}

TEST(MuIRheology, ReturnStaysBetweenTheTwoFrictionsAndBelowTheTrial) {
  std::mt19937 random(3);
  const auto decade = [&](double from, double to) {
    return std::pow(10, std::uniform_real_distribution<double>(from, to)(random));
  };
  for (int n = 0; n < 20000; ++n) {
    MuIRheology law;
    law.static_friction = decade(-2, 0);
    law.dynamic_friction = law.static_friction * (n % 3 ? 1 + decade(-6, 0.5) : 1);
    law.cohesion = n % 2 ? 0 : decade(-3, 6);
    const double p = decade(-8, 8), trial = decade(-8, 10), a = decade(-12, 9);
    const double tau = yield_return(law, trial, p, a);
    const double s0 = law.cohesion + law.static_friction * p;
    const double s2 = law.cohesion + law.dynamic_friction * p;
    ASSERT_TRUE(std::isfinite(tau));
    ASSERT_LE(tau, trial * (1 + 1e-12));
    ASSERT_GE(tau, std::min(trial, s0) * (1 - 1e-9));
    ASSERT_LE(tau, std::max(s0, s2) * (1 + 1e-9));
  }
}

TEST(MuIRheology, ReturnSolvesTheFlowRule) {
  // tau = trial - G dt gamma_p with I = gamma_p d sqrt(rho/p) and tau = c + mu(I) p.
  MuIRheology law = beads();
  law.cohesion = 300;
  const double g = 3e6, p = 4000;
  for (double dt : {1e-6, 1e-3})
    for (double trial : {2500.0, 2900.0, 8000.0}) {
      const double tau = yield_return(law, trial, p, slowness(law, g, dt));
      const double rate = (trial - tau) / (g * dt);
      const double number = rate * law.grain_diameter * std::sqrt(law.grain_density / p);
      EXPECT_NEAR(tau, law.cohesion + friction_at(law, number) * p, 1e-8 * tau);
    }
}

TEST(MuIRheology, FrictionRisesFromStaticToDynamic) {
  const MuIRheology law = beads();
  EXPECT_EQ(friction_at(law, 0), law.static_friction);
  EXPECT_EQ(friction_at(law, -1), law.static_friction);
  EXPECT_DOUBLE_EQ(friction_at(law, law.inertial_number_scale),
                   0.5 * (law.static_friction + law.dynamic_friction));
  EXPECT_NEAR(friction_at(law, 1e12), law.dynamic_friction, 1e-12);
}

}  // namespace
}  // namespace sturz
