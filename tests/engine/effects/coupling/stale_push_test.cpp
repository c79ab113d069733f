// SPDX-License-Identifier: Apache-2.0
// The sweep does not write the ground's push on particles beyond its reach: what another particle
// left there must not be read.
#include "engine/effects/fields.hpp"
#include "tests/support/liquid/immersed_grains.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace sturz::test {
namespace {

ImmersedGrains deep() {
  ImmersedGrains g;
  g.spacing = 0.1;
  g.dilatancy.emplace();
  g.dilatancy->reference_fraction = g.solid_fraction;
  g.dilatancy->law.critical_fraction = 0.55;
  return g;
}

/// Steps with whatever stands in the places that the sweep left alone.
HandMade run(float left_behind) {
  HandMade made = immersed(deep());
  const double reach = 2 * 1.3 * deep().spacing;
  for (int n = 0; n < 20; ++n) {
    made.advance();
    for (MovingSet& p : made.state.sets)
      for (std::size_t i = 0; i < p.size(); ++i)
        if (p.boundary.distance[i] >= 1.5 * reach)
          for (auto& a : p.boundary.from_ground) a[i] = left_behind;
  }
  return made;
}

TEST(StalePush, OfTheGroundIsNotRead) {
  const HandMade clean = run(0), poisoned = run(1e6f);
  for (const std::size_t set : {0, 1}) {
    const MovingSet &a = clean.state.sets[set], &b = poisoned.state.sets[set];
    EXPECT_EQ(a.vx, b.vx) << a.name;
    EXPECT_EQ(a.vz, b.vz) << a.name;
    EXPECT_EQ(a.scalar(fields::density_change), b.scalar(fields::density_change)) << a.name;
  }
}

}  // namespace
}  // namespace sturz::test
