// SPDX-License-Identifier: Apache-2.0
// The drag law against its closed forms, single grains that settle (V13), beds that begin to float
// (V14) and hindered settling (V15).
#include "engine/laws/drag.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

constexpr double gravity = 9.81;

/// Slip at which drag bears the grains' weight in the mixture: beta/a_p u = (1 - a_p)(rho_p - rho)
/// g.
double slip_in_balance(const GranularDrag& law, double solids, double grain_density) {
  const double weight = (1 - solids) * (grain_density - law.density) * gravity;
  double low = 0, high = 1e3;
  for (int n = 0; n < 200; ++n) {
    const double u = 0.5 * (low + high);
    (law.per_grain_volume(solids, u) * u < weight ? low : high) = u;
  }
  return low;
}

TEST(GranularDrag, IsErgunsInPackings) {
  const GranularDrag law{0.002, 1100, 0.01};
  for (const double solids : {0.5, 0.6})
    for (const double u : {0.0, 1e-3, 0.5}) {
      // Pressure drop of a packing by the velocity through its whole section, U = a_f u.
      const double pores = 1 - solids, through = pores * u;
      const double drop =
          150 * solids * solids * 0.01 * through / (pores * pores * pores * 4e-6) +
          1.75 * solids * 1100 * through * through / (pores * pores * pores * 0.002);
      const double beta = solids * law.ergun(solids, u);
      EXPECT_NEAR(beta * u / pores, drop, 1e-12 * drop);
      EXPECT_NEAR(law.exchange(solids, u), beta, 0.01 * beta) << "what the switch leaves of it";
    }
}

TEST(GranularDrag, IsWenAndYusAmongFew) {
  const GranularDrag law{0.001, 1000, 0.001};
  // Stokes: 18 mu/d^2 per volume of grains.
  EXPECT_NEAR(law.per_grain_volume(0, 0), 18 * 0.001 / 1e-6, 1e-9);
  // C_D by hand at Re = 100 and 2000.
  EXPECT_NEAR(law.wen_yu(0, 0.1), 0.75 * 1.0917 * 1000 * 0.1 / 0.001, 10);
  EXPECT_NEAR(law.per_grain_volume(0, 2), 0.75 * 0.44 * 1000 * 2 / 0.001, 1e-6);
  EXPECT_NEAR(law.wen_yu(0.1, 0) / law.wen_yu(0, 0), std::pow(0.9, -2.65), 1e-12);
  // 0.4383 against 0.44: the coefficient's own jump.
  EXPECT_NEAR(law.wen_yu(0, 1.0001) / law.wen_yu(0, 0.9999), 1, 0.005);
}

TEST(GranularDrag, BlendsTheTwo) {
  const GranularDrag law{0.002, 1100, 0.01};
  for (const double a : {0.0, 0.05, 0.19, 0.21, 0.6, 0.95})
    for (const double u : {0.0, 1e-3, 0.5, 30.0}) {
      const double phi = GranularDrag::dispersion(a);
      const double blend = (1 - phi) * law.ergun(a, u) + phi * law.wen_yu(a, u);
      EXPECT_NEAR(law.per_grain_volume(a, u), blend, 1e-13 * blend) << a << " " << u;
    }
}

TEST(GranularDrag, SwitchesWithoutAJump) {
  const GranularDrag law{0.001, 1000, 0.001};
  for (double a = 0; a < 0.95; a += 1e-3)
    EXPECT_LT(std::abs(law.per_grain_volume(a + 1e-3, 0.1) / law.per_grain_volume(a, 0.1) - 1),
              0.35)
        << a;
  EXPECT_NEAR(law.ergun(0.95, 0) / 0.95, law.ergun(0.9, 0) / 0.9, 1e-9) << "pores of a tenth";
}

struct Falling {
  double diameter, grain_density, density, viscosity, speed;
};

/// V13.
TEST(GranularDrag, LetsSingleGrainsFallAtTheirSpeed) {
  for (const Falling& f :
       {Falling{1e-4, 2500, 1000, 1e-3, .00729}, Falling{1e-3, 2650, 1000, 1e-3, .15510},
        Falling{0.02, 2600, 1570, 0.018, .62454}, Falling{0.3, 2800, 1200, 0.2, 3.4483}}) {
    const GranularDrag law{f.diameter, f.density, f.viscosity};
    const double speed = slip_in_balance(law, 0, f.grain_density);
    RecordProperty("speed_m_s", std::to_string(speed));
    EXPECT_NEAR(speed, f.speed, 0.01 * f.speed) << f.diameter;
  }
}

/// V14: the velocity through a packing of 0.6 that bears it.
TEST(GranularDrag, LetsBedsFloatAtErgunsVelocity) {
  for (const Falling& f :
       {Falling{5e-4, 2500, 1.2, 1.8e-5, .21277}, Falling{1e-3, 2500, 1000, 1e-3, .008918},
        Falling{0.02, 2600, 1570, 0.018, .05544}, Falling{0.02, 2600, 1000, 1e-3, .10587}}) {
    const GranularDrag law{f.diameter, f.density, f.viscosity};
    const double through = 0.4 * slip_in_balance(law, 0.6, f.grain_density);
    EXPECT_NEAR(through, f.speed, 0.02 * f.speed) << f.diameter << " " << f.density;
  }
}

/// V15: 0.2 mm glass in water.
TEST(GranularDrag, HindersSettlingAsTheModelHasIt) {
  const GranularDrag law{2e-4, 1000, 1e-3};
  const double solids[] = {.01, .05, .1, .15, .25, .3, .4, .5};
  const double speed[] = {.02212, .018834, .015206, .012078, .006277, .004351, .002097, .000977};
  for (int k = 0; k < 8; ++k)
    EXPECT_NEAR((1 - solids[k]) * slip_in_balance(law, solids[k], 2500), speed[k], 0.02 * speed[k])
        << solids[k];
}

}  // namespace
}  // namespace sturz
