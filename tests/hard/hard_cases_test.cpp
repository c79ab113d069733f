// SPDX-License-Identifier: Apache-2.0
// The cases of B.13 that no verification test covers; each one says what it must keep.
#include "tests/hard/cases/cases.hpp"
#include "tests/hard/expect_holds.hpp"

namespace sturz::test {
namespace {

/// With dense grains alone, and with all states of the grains.
class Hard : public testing::TestWithParam<States> {};

INSTANTIATE_TEST_SUITE_P(With, Hard, testing::Values(States::dense_only, States::all),
                         [](const auto& i) {
                           return i.param == States::all ? "AllStates" : "DenseGrains";
                         });

// I1. Of 0.9 of their critical height banks should stand, and do not: listed as missed.
TEST_P(Hard, CohesiveBankOf90PercentOfItsCriticalHeightStands) {
  expect_holds(bank_near_its_height(GetParam()));
}
TEST_P(Hard, BankInPlaneStrainOf90PercentOfItsCriticalHeightStands) {
  expect_holds(plane_strain_bank_near_its_height(GetParam()));
}
TEST_P(Hard, CohesiveBankOf75PercentOfItsCriticalHeightStands) {
  expect_holds(cohesive_bank_stands(GetParam()));
}
TEST_P(Hard, CohesiveBankOf120PercentOfItsCriticalHeightFalls) {
  expect_holds(tall_bank_falls(GetParam()));
}
TEST(HardDense, BankInPlaneStrainOf120PercentOfItsCriticalHeightFalls) {
  expect_holds(plane_strain_bank_falls(States::dense_only));
}
TEST_P(Hard, CohesiveBarNeitherClumpsNorCrumblesWhenPulled) {
  expect_holds(stretched_bar(GetParam()));
}

// I4
TEST_P(Hard, HeapOnASlopeStaysWhereItIs) { expect_holds(heap_on_a_slope(GetParam())); }

// I11
TEST_P(Hard, FaceOf60DegreesHoldsABlockOf100MetresPerSecond) {
  expect_holds(drop_on_60_degrees(GetParam()));
}
TEST_P(Hard, FaceOf80DegreesHoldsABlockOf100MetresPerSecond) {
  expect_holds(drop_on_80_degrees(GetParam()));
}

// I12
TEST_P(Hard, ShearRateHasNoBandsAsThinAsTheParticles) { expect_holds(banding(GetParam())); }

// I16
TEST_P(Hard, GateLeavesNoEnergyBehindWhenItGoes) { expect_holds(gate_removal(GetParam())); }

// I17
TEST_P(Hard, SteepMemberGivesTheSameBitsAgainAndOnTwoThreads) {
  expect_holds(same_bits(GetParam()));
}

// I5
TEST(HardStates, DoNotFlickerWhereTheirBordersAreCrossed) { expect_holds(breathing(States::all)); }

// I6, I10
TEST(HardStates, StepStaysBoundedUpToTheLargestFraction) {
  expect_holds(pressed_to_the_limit(States::all));
}

// I13
TEST(HardStates, MassThatFliesApartFollowsItsParabola) { expect_holds(jet_breaks_up(States::all)); }

// I14
TEST(HardStates, IsolatedParticlesThatTouchSlowlySeparateAgain) {
  expect_holds(slow_contacts_part(States::all));
}

// I15
TEST(HardStates, ParticlesOfAMemberAreAlikeInMass) { expect_holds(masses_mix(States::all)); }

// I16
TEST(HardStates, IsolatedParticlesThatLeaveAndRejoinMakeNoEnergy) {
  expect_holds(isolated_come_and_go(States::all));
}

}  // namespace
}  // namespace sturz::test
