// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/steady_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

MixtureLaw sand() {
  MixtureLaw law;
  law.fluid_viscosity = 0.001;
  law.critical_fraction = 0.56;
  law.grain_diameter = 2.35e-4;
  return law;
}

TEST(SteadyStress, IsWhereNothingLoosensOrTightens) {
  for (const double m : {0.40, 0.48, 0.55})
    for (const double rate : {0.1, 10.0}) {
      const double stress = steady_stress(sand(), m, rate);
      EXPECT_GT(stress, 0);
      EXPECT_NEAR(dilatancy(sand(), m, rate, stress).tangent, 0, 1e-12) << m << " " << rate;
      EXPECT_GT(dilatancy(sand(), m, rate, 0.5 * stress).tangent, 0);
      EXPECT_LT(dilatancy(sand(), m, rate, 2 * stress).tangent, 0);
    }
  // sqrt N = 0.56/0.48 - 1 = 1/6, so mu gamma 36 less the grains' own collisions.
  EXPECT_NEAR(steady_stress(sand(), 0.48, 10), 0.36 - 2700 * 2.35e-3 * 2.35e-3, 1e-12);
}

TEST(SteadyStress, HasNoEndFromCriticalOn) {
  EXPECT_TRUE(std::isinf(steady_stress(sand(), 0.56, 1)));
  EXPECT_TRUE(std::isinf(steady_stress(sand(), 0.60, 1)));
}

TEST(SteadyStress, IsNothingAtRestAndWhereCollisionsBearMore) {
  EXPECT_EQ(steady_stress(sand(), 0.48, 0), 0);
  EXPECT_EQ(steady_stress(sand(), 0.48, 1e5), 0);
}

}  // namespace
}  // namespace sturz
