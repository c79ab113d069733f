// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/liquid_film.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

/// Mean speed of a film of thickness h that carries the shear stress tau_b at its bed, by
/// quadrature of its velocity over the part that flows: u(z) is the integral of the shear rate
/// under tau = tau_b (1 - z/h), and above it a plug.
double mean_speed(const HerschelBulkley& law, double tau_b, double h) {
  constexpr int n = 20000;
  const double flowing = h * (tau_b - law.yield_stress) / tau_b;
  double speed = 0, sum = 0;
  for (int k = 0; k < n; ++k) {
    const double over = (tau_b - law.yield_stress) * (1 - (k + 0.5) / n);
    const double step = std::pow(over / law.consistency, 1 / law.index) * flowing / n;
    sum += (speed + 0.5 * step) * flowing / n;
    speed += step;
  }
  return (sum + speed * (h - flowing)) / h;
}

TEST(LiquidFilm, IsThatOfThePaperWithoutYieldStress) {
  const LiquidFilm film{{0, 0.2, 1}};
  EXPECT_NEAR(film.bed_stress(1.5, 0.4), 3 * 0.2 * 1.5 / 0.4, 1e-12);
  EXPECT_EQ(film.bed_stress(0, 0.4), 0);
}

TEST(LiquidFilm, AgreesWithTheProfileOfItsLaw) {
  for (const double index : {0.3, 0.6, 1.0, 1.4})
    for (const double yield : {0.0, 5.0, 80.0})
      for (const double over : {1e-3, 1.0, 400.0}) {
        const HerschelBulkley law{yield, 3, index};
        const double tau_b = yield + over, speed = mean_speed(law, tau_b, 0.7);
        EXPECT_NEAR(LiquidFilm{law}.bed_stress(speed, 0.7) - yield, over, 2e-4 * over)
            << index << " " << yield << " " << over;
      }
}

TEST(LiquidFilm, BearsItsYieldStressAtRest) {
  const LiquidFilm film{{50, 3, 0.5}};
  EXPECT_EQ(film.bed_stress(0, 1), 50);
  EXPECT_NEAR(film.bed_stress(1e-12, 1), 50, 1e-2);
}

TEST(LiquidFilm, ALayerAtTheBedOfADeepFlowIsAThickerFilm) {
  // u = g (h z - z^2/2) of a Newtonian film with mu = rho = 1: stress g h at the bed.
  const double g = 2, h = 5;
  for (const double layer : {0.1, 1.0, 3.0, 5.0}) {
    const double mean = g * (h * layer / 2 - layer * layer / 6);
    const double thickness = LiquidFilm::equivalent_thickness(layer, h);
    EXPECT_NEAR(LiquidFilm({0, 1, 1}).bed_stress(mean, thickness), g * h, 1e-12) << layer;
  }
  EXPECT_EQ(LiquidFilm::equivalent_thickness(5, 5), 5);
}

}  // namespace
}  // namespace sturz
