// SPDX-License-Identifier: Apache-2.0
// Events that share their uncertain values: what is joined, and what is refused.
#include "ensemble/workflow/calibration/shared_events.hpp"

#include "engine/core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz::workflow {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Comparison comparison(const std::vector<std::int64_t>& members, double first) {
  Comparison c;
  c.observed = {{"travel_m", 100, 2, "m"}, {"speed_m_s", 14, 1, "m/s"}};
  c.simulated.members = members;
  for (std::size_t i = 0; i < members.size(); ++i)
    c.simulated.values.push_back(
        {{first + static_cast<double>(i), Known::exactly}, {first + 10, Known::at_least}});
  return c;
}

TEST(JointComparison, JoinsTheMembersThatAreValidInEveryEvent) {
  std::vector<std::string> warnings;
  const Comparison joint = joint_comparison({comparison({0, 1, 3}, 50), comparison({1, 2, 3}, 70)},
                                            {"north", "south"}, warnings);
  EXPECT_THAT(joint.simulated.members, ElementsAre(1, 3));
  ASSERT_EQ(joint.observed.size(), 4u);
  EXPECT_EQ(joint.observed[0].name, "north/travel_m");
  EXPECT_EQ(joint.observed[3].name, "south/speed_m_s");
  const auto& one = joint.simulated.values[0];
  ASSERT_EQ(one.size(), 4u);
  EXPECT_EQ(one[0].value, 51);  // member 1 is the second of the north
  EXPECT_EQ(one[2].value, 70);  // and the first of the south
  EXPECT_EQ(one[3].known, Known::at_least);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("2 of 4 members are not valid in every event"));
}

TEST(JointComparison, OfOneEventKeepsItsNames) {
  std::vector<std::string> warnings;
  const Comparison joint = joint_comparison({comparison({0, 1}, 50)}, {"north"}, warnings);
  EXPECT_EQ(joint.observed[0].name, "travel_m");
  EXPECT_TRUE(warnings.empty());
}

TEST(JointComparison, WithoutACommonMemberIsRefused) {
  std::vector<std::string> warnings;
  EXPECT_THROW(joint_comparison({comparison({0}, 50), comparison({1}, 70)}, {"a", "b"}, warnings),
               SetupError);
}

class WhatDiffers : public ::testing::Test {
 protected:
  static DesignTable design() {
    DesignTable d;
    d.keys = {"basal.friction_coefficient"};
    d.units = {"1"};
    d.design = Design::sobol;
    d.unit_cube = {{0.25}, {0.75}};
    d.values = {{0.3}, {0.4}};
    return d;
  }
  Scenario north_, south_;
};

TEST_F(WhatDiffers, NothingWhereOnlyTheGroundDoes) {
  south_.title = "another slope";
  south_.numerics.spacing_m = 7;
  EXPECT_EQ(what_differs(north_, design(), south_, design()), "");
}

TEST_F(WhatDiffers, NamesSeedNumberKeysAndValues) {
  DesignTable other = design();
  other.keys = {"basal.cohesion_pa"};
  EXPECT_THAT(what_differs(north_, design(), south_, other),
              HasSubstr("basal.friction_coefficient against basal.cohesion_pa"));
  other = design();
  other.values.pop_back();
  other.unit_cube.pop_back();
  EXPECT_EQ(what_differs(north_, design(), south_, other), "2 members against 1");
  other = design();
  other.values[1][0] = 0.41;
  EXPECT_EQ(what_differs(north_, design(), south_, other),
            "member 1 has basal.friction_coefficient = 0.4 and 0.41");
  south_.ensemble.seed = north_.ensemble.seed + 4;
  EXPECT_THAT(what_differs(north_, design(), south_, design()), HasSubstr("ensemble.seed: "));
}

}  // namespace
}  // namespace sturz::workflow
