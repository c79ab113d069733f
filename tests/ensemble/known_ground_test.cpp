// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/known_ground.hpp"

#include <gtest/gtest.h>

namespace sturz {
namespace {

TEST(KnownGround, EndsAtHolesAndAtTheRastersSides) {
  Raster<double> bed(Grid{4, 4, 0, 40, 10, ""}, 5.0);
  bed.at(1, 2) = nan_d;
  const Grid map{3, 3, 0, 40, 20, ""};  // one row and column of cells lie beyond the raster
  const KnownGround ground(&bed, {}, map);
  EXPECT_TRUE(ground.at(0, 0));
  EXPECT_TRUE(ground.at(1, 1));
  EXPECT_FALSE(ground.at(0, 2)) << "its centre lies east of the raster";
  EXPECT_FALSE(ground.at(2, 0)) << "south of it";
  const KnownGround fine(&bed, {}, bed.grid);
  EXPECT_FALSE(fine.at(1, 2));
  EXPECT_TRUE(fine.at(2, 1));
}

TEST(KnownGround, WhatIsNotHeldOfTheRasterIsNoHole) {
  const Grid whole{8, 8, 0, 80, 10, ""};
  const Raster<double> held(grid_of({2, 2, 3, 3}, whole), 5.0);
  const KnownGround ground(&held, whole, whole);
  EXPECT_TRUE(ground.at(3, 3));
  EXPECT_TRUE(ground.at(7, 7)) << "on the raster, not read";
}

}  // namespace
}  // namespace sturz
