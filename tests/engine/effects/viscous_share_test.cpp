// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/dense/viscous_share.hpp"

#include <gtest/gtest.h>

namespace sturz {
namespace {

TEST(ViscousShare, ActsInFullWhereNothingYields) {
  EXPECT_EQ(viscous_share(0).acting, 1);
  EXPECT_EQ(viscous_share(0).carried, 0);
}

TEST(ViscousShare, CarriesAtMostATenthOfTheFrictionAndNeverMoreThanAllOfIt) {
  for (const double ratio : {0.01, 0.1, 0.5, 2.0, 4.9}) {
    const ViscousShare v = viscous_share(ratio);
    EXPECT_LE(v.carried, 0.1 + 1e-15) << ratio;
    EXPECT_NEAR(v.carried, v.acting * ratio, 1e-15) << "what acts replaces as much friction";
  }
  for (const double ratio : {20.0, 60.0, 1e9}) {
    EXPECT_EQ(viscous_share(ratio).acting, 0.02);
    EXPECT_LE(viscous_share(ratio).carried, 1);
  }
}

}  // namespace
}  // namespace sturz
