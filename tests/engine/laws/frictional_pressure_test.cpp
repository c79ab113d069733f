// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/frictional_pressure.hpp"

#include "engine/laws/grain_states.hpp"
#include "engine/laws/kinetic_theory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

FrictionalPressure with_max(double max_fraction) {
  FrictionalPressure law;
  law.max_fraction = max_fraction;
  return law;
}

TEST(FrictionalPressure, HasThePublishedValues) {  // docs/physics.md A.7, B.9
  const struct {
    double max_fraction, fraction, pressure, digits;
  } published[] = {{0.63, 0.55, 38, 0.5},   {0.63, 0.58, 1.0e3, 50}, {0.63, 0.60, 20.6e3, 50},
                   {0.65, 0.55, 13, 0.5},   {0.65, 0.58, 190, 0.5},  {0.65, 0.60, 1.6e3, 50},
                   {0.65, 0.62, 30e3, 500}, {0.74, 0.55, 0.5, 0.05}, {0.74, 0.58, 3, 0.5},
                   {0.74, 0.60, 9.3, 0.05}, {0.74, 0.62, 29, 0.5},   {0.64, 0.60, 4.9e3, 50},
                   {0.68, 0.60, 152, 0.9}};
  for (const auto& [max_fraction, fraction, pressure, digits] : published)
    EXPECT_NEAR(with_max(max_fraction).at(fraction), pressure, digits)
        << max_fraction << ' ' << fraction;
}

TEST(FrictionalPressure, GapHasAFloor) {
  // Without it the table's 0.62 of 0.63 is 7.2 MPa; the floor of 0.02 makes that 2^5 times less.
  EXPECT_NEAR(with_max(0.63).at(0.62), 7.2e6 / 32, 1);
  EXPECT_NEAR(with_max(0.63).at(0.70), 0.05 * 0.04 / std::pow(0.02, 5), 1e-3);
}

TEST(FrictionalPressure, NothingBelowTheLoosestPacking) {
  const FrictionalPressure law;
  for (double a : {0.0, 0.3, 0.5}) {
    EXPECT_EQ(law.at(a), 0);
    EXPECT_EQ(law.slope(a), 0);
  }
  EXPECT_GT(law.at(0.501), 0);
}

TEST(FrictionalPressure, NeverFallsWithTheFraction) {
  for (double max_fraction : {0.63, 0.64, 0.74})
    for (double steepest : {1e3, 1e5, 1e7, 1e10, 0.0}) {
      FrictionalPressure law = with_max(max_fraction);
      if (steepest > 0) law.limit_slope(steepest);
      for (double a = 0.45; a < 0.9; a += 1e-4) {
        const double rise = law.at(a + 1e-4) - law.at(a);
        ASSERT_GE(rise, 0) << a << " of " << max_fraction;
        ASSERT_LE(rise, 1e-4 * law.steepest * (1 + 1e-9)) << a;
        ASSERT_TRUE(rise > 0 || a <= 0.5) << a;
      }
    }
}

TEST(FrictionalPressure, SlopeIsTheDerivative) {
  FrictionalPressure limited;
  limited.limit_slope(2e5);
  for (const FrictionalPressure& law : {FrictionalPressure{}, limited})
    for (double a : {0.51, 0.55, 0.59, 0.61, 0.63, 0.66}) {
      const double h = 1e-6, numeric = (law.at(a + h) - law.at(a - h)) / (2 * h);
      EXPECT_NEAR(law.slope(a), numeric, 1e-5 * numeric) << a;
    }
}

TEST(FrictionalPressure, LimitedSlopeGoesOnFromTheCrossover) {
  const FrictionalPressure bare;
  FrictionalPressure law;
  law.limit_slope(2e5);
  ASSERT_GT(law.crossover, 0.55);
  ASSERT_LT(law.crossover, 0.62);
  EXPECT_NEAR(bare.slope(law.crossover), 2e5, 1e-6 * 2e5);
  EXPECT_EQ(law.at(law.crossover), bare.at(law.crossover));
  EXPECT_EQ(law.at(0.58), bare.at(0.58));
  EXPECT_NEAR(law.at(law.crossover + 0.1), bare.at(law.crossover) + 2e4, 1e-6);
  EXPECT_EQ(law.slope(0.7), 2e5);
  // A limit that the law never reaches before the floor of the gap leaves it alone there.
  FrictionalPressure loose;
  loose.limit_slope(1e12);
  EXPECT_EQ(loose.at(0.6199), bare.at(0.6199));
  // Setting another limit forgets the first.
  law.limit_slope(1e12);
  EXPECT_EQ(law.at(0.6199), bare.at(0.6199));
}

TEST(FrictionalPressure, SumWithTheElasticPressureNeverFalls) {
  // B.9's rule: p(alpha, theta = 0) = p_el + p_fric, with the elastic part from alpha_ref on.
  for (double start : {0.55, 0.60, 0.70}) {
    const double reference = std::max(0.60, start), bulk = 5e6;
    FrictionalPressure law = with_max(std::max(0.64, start + 0.08));
    law.limit_slope(bulk / reference);
    double last = 0;
    for (double a = 0.3; a < 0.8; a += 1e-4) {
      const double p = bulk * std::max(0.0, a / reference - 1) + law.at(a);
      ASSERT_GE(p, last) << a << " from " << start;
      last = p;
    }
    EXPECT_GT(last, 1e5);
  }
}

TEST(GrainStates, AreNamedByFraction) {
  EXPECT_EQ(grain_state(0.7), GrainState::dense);
  EXPECT_EQ(grain_state(0.601), GrainState::dense);
  EXPECT_EQ(grain_state(0.60), GrainState::transition);
  EXPECT_EQ(grain_state(0.50), GrainState::transition);
  EXPECT_EQ(grain_state(0.499), GrainState::dilute);
  EXPECT_EQ(grain_state(0.02), GrainState::dilute);
  EXPECT_EQ(grain_state(0.0199), GrainState::ultradilute);
  EXPECT_EQ(grain_state(0), GrainState::ultradilute);
  EXPECT_LT(leave_dense_fraction, reenter_dense_fraction);
  EXPECT_LT(detach_fraction, attach_fraction);
  EXPECT_LT(detach_neighbors, attach_neighbors);
}

TEST(GrainStates, KineticStressesFadeSmoothlyBetweenHalfAndSixTenths) {
  EXPECT_EQ(kinetic_weight(0.1), 1);
  EXPECT_EQ(kinetic_weight(0.50), 1);
  EXPECT_NEAR(kinetic_weight(0.525), 1 - 0.15625, 1e-12);
  EXPECT_NEAR(kinetic_weight(0.55), 0.5, 1e-12);
  EXPECT_NEAR(kinetic_weight(0.60), 0, 1e-12);
  EXPECT_EQ(kinetic_weight(0.7), 0);
  for (double a = 0.45; a < 0.65; a += 1e-4) {
    EXPECT_LE(kinetic_weight(a + 1e-4), kinetic_weight(a));
    EXPECT_LT(kinetic_weight(a) - kinetic_weight(a + 1e-4), 1.51e-3);  // slope at most 1.5/0.1
  }
}

TEST(GrainStates, PressureOfHotGrainsIsContinuousAcrossTheTransition) {
  // p_el + p_fric + w_k p_k at a fixed theta: no jump anywhere between loose and packed.
  KineticTheory kinetic;
  FrictionalPressure frictional;
  const double theta = 0.04, step = 1e-6;
  const auto p = [&](double a) {
    return 5e6 * std::max(0.0, a / 0.6 - 1) + frictional.at(a) +
           kinetic_weight(a) * kinetic_coefficients(kinetic, a).pressure * theta;
  };
  for (double a = 0.4; a < 0.619; a += 1e-3) EXPECT_NEAR(p(a + step), p(a), 2e-3 * p(a) + 10) << a;
}

}  // namespace
}  // namespace sturz
