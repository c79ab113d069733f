// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/basal_resistance.hpp"

#include "engine/core/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

constexpr double g = standard_gravity, density = 2000;

/// A bed with nothing but the named terms.
BasalResistance bare(double friction = 0) {
  BasalResistance b;
  b.friction_coefficient = friction;
  return b;
}

BasalResistance bingham(double viscosity, double yield) {
  BasalResistance b = bare();
  b.viscosity_pa_s = viscosity;
  b.yield_stress_pa = yield;
  return b;
}

TEST(BasalResistance, CoulombFrictionIsReducedByPorePressure) {
  BasalResistance b = bare(0.4);
  EXPECT_NEAR(b.plastic(8, 3, density, 0), 0.4 * 8, 1e-15);
  b.pore_pressure_ratio = 0.75;
  EXPECT_NEAR(b.effective_friction(), 0.1, 1e-16);
  EXPECT_NEAR(b.plastic(8, 3, density, 0), 0.1 * 8, 1e-15);
  EXPECT_EQ(b.plastic(0, 3, density, 0), 0) << "a column in the air is not braked";
  EXPECT_FALSE(b.has_rate());
  EXPECT_EQ(b.rate(10, 3, density, g), 0);
}

TEST(BasalResistance, CohesionBrakesAThinFlowMore) {
  BasalResistance b = bare(0.4);
  b.cohesion_pa = 600;
  EXPECT_NEAR(b.plastic(8, 3, density, 0), 3.2 + 600.0 / (2000 * 3), 1e-15);
  EXPECT_NEAR(b.plastic(8, 0.3, density, 0), 3.2 + 1, 1e-15);
  EXPECT_NEAR(b.plastic(0, 3, density, 0), 0.1, 1e-16) << "whatever presses";
}

TEST(BasalResistance, VoellmyGrowsWithTheSquareOfSpeed) {
  BasalResistance b = bare(0.1);
  b.turbulent_coefficient = 500;
  EXPECT_TRUE(b.has_rate());
  for (const double v : {0.0, 0.5, 20.0, 80.0})
    EXPECT_NEAR(b.rate(v, 4, density, g) * v, g * v * v / (500 * 4), 1e-14 * (1 + v * v));
  // Steady speed of a sheet: v^2 = xi h (sin - mu cos).
  const double slope = std::atan(0.3), pull = g * std::sin(slope) - 0.1 * g * std::cos(slope);
  const double v = std::sqrt(500 * 4 * pull / g);
  EXPECT_NEAR(b.rate(v, 4, density, g) * v, pull, 1e-13);
}

TEST(BasalResistance, LaminarDragIsThreeViscositiesOfTheMeanShear) {
  BasalResistance b = bare();
  b.viscosity_pa_s = 150;
  for (const double v : {1e-6, 0.3, 12.0}) {
    EXPECT_NEAR(b.bingham_stress(v, 2), 3 * 150 * v / 2, 1e-13 * (1 + v * 225));
    EXPECT_NEAR(b.rate(v, 2, density, g), 3 * 150 / (density * 4), 1e-15);
  }
  EXPECT_NEAR(b.rate(0, 2, density, g), 3 * 150 / (density * 4), 1e-12) << "at rest too";
}

TEST(BasalResistance, TermsAddUp) {
  BasalResistance turbulent = bare(0.2), viscous = bingham(40, 0), both = turbulent;
  turbulent.turbulent_coefficient = both.turbulent_coefficient = 700;
  both.viscosity_pa_s = 40;
  EXPECT_NEAR(both.rate(7, 1.5, density, g),
              turbulent.rate(7, 1.5, density, g) + viscous.rate(7, 1.5, density, g), 1e-15);
  BasalResistance sticky = bare(0.2);
  sticky.cohesion_pa = 100, sticky.yield_stress_pa = 50;
  EXPECT_NEAR(sticky.plastic(5, 1.5, density, 0), 1 + 150 / (density * 1.5), 1e-15);
}

/// What the cubic leaves, over the size of its terms.
double cubic_residual(const BasalResistance& b, double v, double h) {
  const double tau = b.bingham_stress(v, h), y = b.yield_stress_pa;
  const double driven = 3 * (y + 2 * b.viscosity_pa_s * v / h) * tau * tau;
  return (2 * tau * tau * tau - driven + y * y * y) / driven;
}

TEST(BinghamStress, SatisfiesItsCubicOverSixDecadesOfSpeed) {
  for (const double yield : {10.0, 2000.0})
    for (const double h : {0.2, 5.0})
      for (double v = 1e-4; v < 200; v *= 1.7) {
        const BasalResistance b = bingham(50, yield);
        EXPECT_NEAR(cubic_residual(b, v, h), 0, 1e-14) << yield << " " << h << " " << v;
        EXPECT_GE(b.bingham_stress(v, h), yield);
      }
}

/// Mean speed of a film of thickness h under the basal stress tau: a plug over a sheared layer.
double film_speed(const BasalResistance& b, double tau, double h) {
  const double sheared = h * (1 - b.yield_stress_pa / tau);
  const double plug = tau / h * sheared * sheared / (2 * b.viscosity_pa_s);
  return plug * (1 - sheared / (3 * h));
}

TEST(BinghamStress, IsThatOfTheFilmWithItsSpeed) {
  const BasalResistance b = bingham(30, 800);
  for (const double over : {1e-3, 0.01, 0.3, 2.0, 50.0}) {
    const double tau = 800 * (1 + over), v = film_speed(b, tau, 1.3);
    EXPECT_NEAR(b.bingham_stress(v, 1.3) - 800, tau - 800, 1e-9 * tau) << over;
  }
}

TEST(BinghamStress, TendsToItsYieldStressAtRestAsTheRootOfSpeed) {
  const BasalResistance b = bingham(30, 800);
  EXPECT_NEAR(b.bingham_stress(0, 2), 800, 1e-9);
  for (const double v : {1e-9, 1e-7, 1e-5, 1e-3}) {
    // tau_b = tau_y (1 + sqrt(a/3)) for small a = 6 eta v/(h tau_y); the next term is a/3.
    const double a = 6 * 30 * v / (2 * 800), first = std::sqrt(a / 3);
    EXPECT_NEAR((b.bingham_stress(v, 2) / 800 - 1) / first, 1, 2 * first + 1e-6) << v;
  }
}

TEST(BinghamStress, TendsToThreeHalvesOfYieldPlusLaminarDragWhenFast) {
  const BasalResistance b = bingham(30, 800);
  for (const double v : {1e3, 1e5, 1e7}) {
    const double limit = 1.5 * 800 + 3 * 30 * v / 2;
    // The first term that is left out is tau_y^3/(2 tau_b^2).
    EXPECT_NEAR(b.bingham_stress(v, 2), limit, 800 * std::pow(800 / limit, 2) + 1e-13 * limit);
  }
}

TEST(BinghamStress, RateAndPlasticPartMakeUpItsDeceleration) {
  const BasalResistance b = bingham(30, 800);
  for (const double v : {1e-8, 1e-3, 0.1, 5.0, 70.0}) {
    const double all = b.plastic(9, 1.7, density, 0) + v * b.rate(v, 1.7, density, g);
    EXPECT_NEAR(all, b.bingham_stress(v, 1.7) / (density * 1.7), 1e-14);
  }
  EXPECT_TRUE(std::isfinite(b.rate(0, 1.7, density, g)));
}

}  // namespace
}  // namespace sturz
