// SPDX-License-Identifier: Apache-2.0
// What walls mirror of grains whose packing has changed.
#include "engine/effects/bed/mirrored.hpp"

#include <gtest/gtest.h>

namespace sturz {
namespace {

/// The push is stress over the density that is there: packing and load together.
TEST(WallPressure, KnowsThePackingOfTheGrains) {
  MovingSet p;
  p.grow(2);
  p.add(fields::stress);
  p.add(fields::density_change);
  p.boundary.mirror_weight.assign(2, 1.0f);
  for (auto* component : {&p.components(fields::stress)[0]}) component->assign(2, -1000.0);
  p.scalar(fields::density_change).assign(2, 0.02);
  ContactSettings c;
  c.reference_density = 1500;
  const double plane = 0.3, alone = 2 * 1000 * plane / (1500 * 1.02);
  EXPECT_NEAR(WallPressure::of_walls(p, c).acceleration(0, plane, 1, 0, 0), alone, 1e-12);
  p.add(fields::packing_change);
  p.scalar(fields::packing_change)[1] = -0.1;
  const WallPressure walls = WallPressure::of_walls(p, c);
  EXPECT_NEAR(walls.acceleration(0, plane, 1, 0, 0), alone, 1e-12);
  EXPECT_NEAR(walls.acceleration(1, plane, 1, 0, 0), alone / 0.9, 1e-12);
}

}  // namespace
}  // namespace sturz
