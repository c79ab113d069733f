// SPDX-License-Identifier: Apache-2.0
// What is said of the ground names where the energy line's friction comes from.
#include "scenarios/assembly/ground_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

SceneInputs meeting_the_end(double friction) {
  SceneInputs in;
  Reach reach;
  reach.friction = friction;
  reach.above_end_m = 822, reach.end = "south";
  in.reach = reach;
  return in;
}

TEST(GroundWords, AFrictionOfTheFileStandsAlone) {
  Scenario s;
  s.basal.friction_coefficient = 0.08;
  EXPECT_THAT(ground_warnings(s, meeting_the_end(0.08)),
              ElementsAre(HasSubstr("the energy line of the least friction drawn (0.08) still")));
}

TEST(GroundWords, PorePressureIsNamedWhereItIsTakenOff) {
  Scenario s;
  s.basal.friction_coefficient = 0.2;
  s.basal.pore_pressure_ratio = 0.3;
  EXPECT_THAT(
      ground_warnings(s, meeting_the_end(0.14)),
      ElementsAre(HasSubstr("least friction drawn, less the most pore pressure (0.14) still")));
  s.basal.pore_pressure_ratio = 0;
  s.basal.zones.emplace_back();
  EXPECT_THAT(ground_warnings(s, meeting_the_end(0.2)),
              ElementsAre(HasSubstr("least friction drawn (0.2) still")));
  s.basal.zones[0].pore_pressure_ratio = 0.85;
  EXPECT_THAT(
      ground_warnings(s, meeting_the_end(0.03)),
      ElementsAre(HasSubstr("least friction drawn, less the most pore pressure (0.03) still")));
}

TEST(GroundWords, AMixtureMayLiquefy) {
  Scenario s;
  s.basal.friction_coefficient = 0.73;
  s.mixture.emplace();
  EXPECT_THAT(ground_warnings(s, meeting_the_end(0.073)),
              ElementsAre(HasSubstr("a nearly liquefied mixture (friction 0.073) still")));
}

TEST(GroundWords, GapsMayBeTheEndOfATurnedRaster) {
  SceneInputs in = meeting_the_end(0.1);
  in.reach->above_end_m = 0;
  in.reach->above_unknown_m = 12;
  EXPECT_THAT(ground_warnings({}, in),
              ElementsAre(HasSubstr("Fill the terrain there, or use one that goes on there.")));
}

}  // namespace
}  // namespace sturz
