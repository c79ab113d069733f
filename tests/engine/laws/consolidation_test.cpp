// SPDX-License-Identifier: Apache-2.0
// Where nodes of a profile are, and what drives it.
#include "engine/laws/consolidation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

TEST(ProfileMesh, NodesStandForTheWholeThickness) {
  for (const bool drained : {false, true})
    for (int n = 5; n <= 10; ++n) {
      const ProfileMesh mesh{n, drained};
      double sum = 0;
      for (int j = 0; j < n; ++j) sum += mesh.weight(j);
      EXPECT_NEAR(sum, 1, 1e-15);
      EXPECT_EQ(mesh.height(0) == 0, !drained) << "on a tight bed the lowest node is its pressure";
      EXPECT_NEAR(1 - mesh.height(n - 1), 0.5 * mesh.spacing(), 1e-15);
    }
}

TEST(ProfileRates, SlopesAreThoseOfTheRates) {
  MixtureLaw law;
  law.fluid_density = 1100;
  for (const double m : {0.55, 0.62, 0.66})
    for (const double borne : {50.0, 3000.0}) {
      const double by = 1e-3, speed = 4, per_h = 0.5, k = law.permeability_at(m);
      // More pressure at the base is less stress on the grains.
      const ProfileRates at = profile_rates(law, m, k, borne, speed, per_h),
                         less = profile_rates(law, m, k, borne - by, speed, per_h),
                         more = profile_rates(law, m, k, borne + by, speed, per_h);
      EXPECT_NEAR((less.source - more.source) / (2 * by) / at.source_slope, 1, 1e-4) << m << borne;
      EXPECT_NEAR((less.diffusivity - more.diffusivity) / (2 * by) / at.diffusivity_slope, 1, 1e-4);
      EXPECT_NEAR(at.diffusivity, k * m * (borne + 1000) / (0.05 * 0.005), 1e-9 * at.diffusivity);
    }
}

TEST(ProfileRates, NothingDilatesAtRest) {
  const MixtureLaw law;
  const ProfileRates rates = profile_rates(law, 0.7, 1e-9, 2000, 0, 1);
  EXPECT_EQ(rates.source, 0);
  EXPECT_EQ(rates.source_slope, 0);
  EXPECT_EQ(profile_rates(law, 0.7, 1e-9, 0, 0, 1).diffusivity_slope, 0) << "liquefied, at rest";
}

}  // namespace
}  // namespace sturz
