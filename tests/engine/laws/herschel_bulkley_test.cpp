// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/herschel_bulkley.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sturz {
namespace {

/// With and without yield stress, down to the shear thinning of a mud.
std::vector<HerschelBulkley> laws() {
  std::vector<HerschelBulkley> all;
  for (const double index : {1.0, 0.5, 0.3})
    for (const double yield : {0.0, 40.0})
      for (const double consistency : {1e-3, 2.0, 300.0})
        all.push_back({yield, consistency, index});
  return all;
}

/// The slow twin: bisection for tau of trial - tau = G dt ((tau - tau_y)/K)^(1/n), whose left side
/// falls while the right one rises.
double root_by_bisection(const HerschelBulkley& law, double trial, double stiffness) {
  long double low = std::min(trial, law.yield_stress), high = trial;
  for (int k = 0; k < 200; ++k) {
    const long double tau = (low + high) / 2;
    const long double rate = std::pow((tau - law.yield_stress) / law.consistency, 1 / law.index);
    (trial - tau > stiffness * rate ? low : high) = tau;
  }
  return static_cast<double>(low);
}

TEST(HerschelBulkley, RelaxesToTheRootOfItsFlowRule) {
  for (const HerschelBulkley& law : laws())
    for (const double trial : {41.0, 60.0, 1e3, 1e5})
      for (const double stiffness : {1e-4, 0.1, 30.0, 1e4}) {
        const double expected = root_by_bisection(law, trial, stiffness);
        EXPECT_NEAR(law.relaxed(trial, stiffness), expected, 1e-12 * trial)
            << law.yield_stress << " " << law.consistency << " " << law.index << " " << trial << " "
            << stiffness;
      }
}

TEST(HerschelBulkley, HoldsWhatIsBelowItsYieldStress) {
  for (const HerschelBulkley& law : laws())
    for (const double share : {0.0, 0.3, 1.0})
      for (const double stiffness : {1e-9, 1.0, 1e9})
        EXPECT_EQ(law.relaxed(share * law.yield_stress, stiffness), share * law.yield_stress);
}

/// Sheared at one rate it comes to the stress of that rate, whatever the step.
TEST(HerschelBulkley, SteadyStressDoesNotDependOnTheStep) {
  const double modulus = 5e4;
  for (const HerschelBulkley& law : laws())
    for (const double rate : {0.02, 1.0, 50.0})
      for (const double dt : {5e-4, 1e-2, 0.3}) {
        double tau = 0, last = -1;
        for (int n = 0; n < 4'000'000 && std::abs(tau - last) > 1e-11 * tau; ++n) {
          last = tau;
          tau = law.relaxed(tau + modulus * dt * rate, modulus * dt);
        }
        EXPECT_NEAR(tau, law.stress(rate), 1e-5 * law.stress(rate))
            << law.yield_stress << " " << law.consistency << " " << law.index << " " << rate << " "
            << dt;
      }
}

TEST(HerschelBulkley, IsElasticWithoutTimeAndTheLawItselfWithEnoughOfIt) {
  for (const HerschelBulkley& law : laws()) {
    const double trial = law.yield_stress + 25, rate = 3;
    const double flowing = std::pow(25 / law.consistency, 1 / law.index);  // under the trial [1/s]
    EXPECT_NEAR(law.relaxed(trial, 1e-7 * trial / flowing), trial, 1e-6 * trial);
    // trial = tau + G dt rate with G dt far above K.
    const double stiffness = 1e6 * law.consistency;
    EXPECT_NEAR(law.relaxed(law.stress(rate) + stiffness * rate, stiffness), law.stress(rate),
                1e-8 * stiffness * rate);
  }
}

TEST(HerschelBulkley, NeitherPassesTheTrialNorFallsBelowItsYieldStress) {
  for (const HerschelBulkley& law : laws())
    for (double trial = 1e-9; trial < 1e9; trial *= 7)
      for (double stiffness = 1e-12; stiffness < 1e12; stiffness *= 31) {
        const double tau = law.relaxed(trial, stiffness);
        ASSERT_TRUE(std::isfinite(tau)) << trial << " " << stiffness;
        ASSERT_LE(tau, trial * (1 + 1e-14));
        ASSERT_GE(tau, std::min(trial, law.yield_stress) - 1e-13 * trial);
      }
}

TEST(HerschelBulkley, StressRisesWithTheTrialAndFallsWithTime) {
  for (const HerschelBulkley& law : laws()) {
    double last = 0;
    for (double trial = 1; trial < 1e5; trial *= 1.3) {
      const double tau = law.relaxed(trial, 2);
      EXPECT_GT(tau, last);
      EXPECT_LE(law.relaxed(trial, 4), tau);
      last = tau;
    }
  }
}

/// Water to the stiffest mud, from rest to a bullet: finite, and never of the other sign.
TEST(HerschelBulkley, HasNoNumbersThatAreNone) {
  for (const double index : {1.0, 0.3})
    for (const double consistency : {0.0, 1e-6, 1e3})
      for (const double yield : {0.0, 5e3})
        for (const double trial : {0.0, 1e-300, 1e-20, 1.0, 1e12})
          for (const double stiffness : {1e-15, 1.0, 1e15}) {
            const HerschelBulkley law{yield, consistency, index};
            const double tau = law.relaxed(trial, stiffness);
            EXPECT_TRUE(std::isfinite(tau) && tau >= -1e-13 * trial)
                << index << " " << consistency << " " << yield << " " << trial << " " << stiffness;
          }
}

}  // namespace
}  // namespace sturz
