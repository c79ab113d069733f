// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/dense/packing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

DilatantPacking loose(bool paper_switch = false) {
  DilatantPacking p{2e7, 0.6, {}, paper_switch, std::exp(-0.1)};
  p.friction.max_fraction = 0.68;
  return p;
}

TEST(DilatantPacking, PressureNeverFallsWithTheFractionAndHasNoJump) {
  const DilatantPacking p = loose();
  double before = p.pressure(-0.99, 0, 0);
  EXPECT_EQ(before, 0);
  for (double e = -0.99; e < 0.05; e += 1e-5) {
    const double now = p.pressure(e, 0, 0);
    EXPECT_GE(now, before);
    EXPECT_LT(now - before, 1e-5 * (p.bulk + 1e6));
    before = now;
  }
}

TEST(DilatantPacking, ExpansionNeverEmptiesAGrain) {
  for (const double e : {-0.9, -0.3, 0.0, 0.01})
    for (const double strain : {-0.5, -0.01, 0.0, 0.01, 0.5, 10.0}) {
      EXPECT_GT(DilatantPacking::carried(e, strain), -1);
      EXPECT_NEAR(DilatantPacking::carried(e, strain), e - strain * (1 + e),
                  1.1 * strain * strain + 1e-15);
    }
}

TEST(DilatantPacking, DensityStaysWhatTheSurroundingsAllow) {
  constexpr double separation_threshold = GrainStressSettings::separation_threshold;
  // Inside a full support no grain is dilute, and none is pressed by being called dense.
  EXPECT_NEAR(DilatantPacking::bounded(-0.9, 1, false), -0.15, 1e-12);
  EXPECT_LE(DilatantPacking::bounded(-0.9, 1.5, false), separation_threshold);
  // Loaded or surface grains are left alone.
  for (const double e : {-0.05, 0.0, 0.02})
    for (const double completeness : {0.45, 0.7, 1.0})
      EXPECT_EQ(DilatantPacking::bounded(e, completeness, false), e);
  // Without neighbours no grain is dense, except on the ground.
  EXPECT_NEAR(DilatantPacking::bounded(0.01, 0.1 * DilatantPacking::sparse, false), -0.9, 1e-12);
  EXPECT_EQ(DilatantPacking::bounded(-0.9, 0.03, true), separation_threshold);
  EXPECT_EQ(DilatantPacking::bounded(0.01, 0.03, true), 0);
  EXPECT_EQ(DilatantPacking::bounded(0.01, 0.5, true), 0.01);
}

TEST(DilatantPacking, FewNeighboursHoldLittlePressure) {
  // Five grains in flight that hit the ground at 90 m/s: compressed by 9 % at a support
  // completeness of 0.19, they threw one of them off at 1.1 times the speed of free fall.
  for (const bool touching : {false, true})
    EXPECT_LT(DilatantPacking::bounded(0.09, 0.19, touching), 0.015);
  double before = 0;
  for (double completeness = DilatantPacking::sparse; completeness < 0.7; completeness += 1e-3) {
    const double now = DilatantPacking::bounded(0.2, completeness, true);
    EXPECT_GE(now, before);
    EXPECT_LT(now - before, 0.01);  // no jump
    before = now;
  }
  EXPECT_EQ(before, 0.2);
  // A corner of a heap at rest keeps its load.
  EXPECT_EQ(DilatantPacking::bounded(0.01, 0.3, true), 0.01);
}

TEST(DilatantPacking, CohesionEndsWhereGrainsSeparate) {
  MuIRheology law;
  law.cohesion = 5000;
  const DilatantPacking p = loose();
  EXPECT_EQ(p.yielding(law, 0.01).cohesion, 5000);
  EXPECT_EQ(p.yielding(law, -0.2).cohesion, 0);
  EXPECT_NEAR(p.yielding(law, GrainStressSettings::separation_threshold).cohesion, 5000, 1e-6);
  EXPECT_NEAR(p.yielding(law, -0.03).cohesion, 2500, 1e-6);
}

TEST(DilatantPacking, RatioIsNotSmoothedWhereCohesionAloneHolds) {
  MuIRheology law;
  const double trace = loose().pressure(-0.01, 0, 0);
  ASSERT_GT(trace, 0);
  EXPECT_TRUE(DilatantPacking::smooths(-0.01, trace, law));  // loose, but pressed all the same
  EXPECT_FALSE(DilatantPacking::smooths(-0.5, 0, law));
  law.cohesion = 5000;
  EXPECT_FALSE(DilatantPacking::smooths(-0.01, trace, law));
  EXPECT_FALSE(DilatantPacking::smooths(0, 0, law));
  EXPECT_TRUE(DilatantPacking::smooths(0.001, 2e4, law));
}

TEST(DilatantPacking, PaperSwitchRelaxesThePressureToTheLawOfItsState) {
  const DilatantPacking p = loose(true);
  const auto dense = static_cast<double>(GrainState::dense);
  const auto transition = static_cast<double>(GrainState::transition);
  const double kept = std::exp(-0.1);
  EXPECT_DOUBLE_EQ(p.pressure(0.001, 0, dense), 2e4 * (1 - kept));
  // Out of the dense state the elastic pressure fades to Eq. (23).
  const double target = p.friction.at(0.57);
  EXPECT_NEAR(p.pressure(0.57 / 0.6 - 1, 2e4, transition), target + (2e4 - target) * kept, 1e-9);
}

TEST(GrainStressSettings, DensityChangeCarriesTheAskedPressure) {
  GrainStressSettings g;
  g.states = GrainStatesSettings{};
  g.states->friction.max_fraction = 0.68;
  for (const double pressure : {200.0, 1e3, 1e4, 1e6})
    EXPECT_NEAR(g.pressure_at(g.density_change_at(pressure)) / pressure, 1, 1e-9);
  EXPECT_EQ(g.density_change_at(10), 0);  // the frictional pressure alone is 152 Pa at 0.60
}

}  // namespace
}  // namespace sturz
