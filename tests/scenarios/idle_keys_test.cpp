// SPDX-License-Identifier: Apache-2.0
/// Keys without effect, and words of other programs.
#include "scenarios/checks/idle_keys.hpp"

#include "scenarios/schema/foreign_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

Scenario with_grains() {
  Scenario s;
  s.grains.emplace();
  return s;
}

TEST(IdleKeys, DefaultsAreNotGiven) {
  EXPECT_THAT(idle_keys(with_grains(), true), IsEmpty());
  EXPECT_THAT(idle_keys(with_grains(), false), IsEmpty());
}

TEST(IdleKeys, InternalFrictionDoesNothingInIsotropicColumns) {
  Scenario s = with_grains();
  s.grains->friction_angle_deg = Uncertain(30);
  EXPECT_THAT(idle_keys(s, true), ElementsAre("grains.friction_angle_deg"));
  EXPECT_THAT(idle_keys(s, false), IsEmpty());
  EXPECT_THAT(idle_keys(s, true, true), IsEmpty()) << "a pile";
  s.grains->earth_pressure = LateralPressure::active_passive;
  EXPECT_THAT(idle_keys(s, true), IsEmpty());
}

TEST(IdleKeys, OfMuIOnlyTheSlowPartActsOnColumns) {
  Scenario s = with_grains();
  s.grains->friction = FrictionLaw{Uncertain(0.5), Uncertain(0.9), Uncertain(0.2)};
  s.grains->earth_pressure = LateralPressure::active_passive;
  EXPECT_THAT(idle_keys(s, true),
              ElementsAre("grains.friction.dynamic", "grains.friction.inertial_number_scale"));
}

TEST(IdleKeys, ColumnsHaveNoGrainsInside) {
  Scenario s = with_grains();
  s.grains->diameter_m = Uncertain(3);
  s.grains->cohesion_pa = Uncertain(5000);
  s.basal.restitution = Uncertain(0.5);
  s.numerics.density_diffusion = 0.3;
  EXPECT_THAT(idle_keys(s, true), ElementsAre("grains.diameter_m", "grains.cohesion_pa",
                                              "basal.restitution", "numerics.density_diffusion"));
  EXPECT_THAT(idle_keys(s, false), IsEmpty());
}

TEST(IdleKeys, TheDiameterNeedsARate) {
  Scenario s = with_grains();
  s.grains->diameter_m = Uncertain(3);
  s.grains->friction_angle_deg = Uncertain(30);
  EXPECT_THAT(idle_keys(s, false), ElementsAre("grains.diameter_m"));
  s.grains->states.emplace();
  EXPECT_THAT(idle_keys(s, false), IsEmpty());
}

TEST(ForeignWords, SayWhatToWriteHere) {
  EXPECT_THAT(advice_on_foreign_word("basal.xi"),
              StartsWith("Use basal.turbulent_coefficient_m_s2: Voellmy's xi"));
  EXPECT_THAT(advice_on_foreign_word("Xi"), HasSubstr("turbulent_coefficient"));
  EXPECT_THAT(advice_on_foreign_word("basal.mu"), StartsWith("Use basal.friction_coefficient"));
  EXPECT_THAT(advice_on_foreign_word("basal.tau0_pa"), StartsWith("Use basal.yield_stress_pa"));
  EXPECT_THAT(advice_on_foreign_word("entrainment"), StartsWith("Use the block erosion"));
  EXPECT_THAT(advice_on_foreign_word("release.hydrograph"), StartsWith("Use the list inflow"));
  EXPECT_THAT(advice_on_foreign_word("release.secondary"),
              StartsWith("Use release.start_time_attribute"));
}

TEST(ForeignWords, ObstaclesAndForestHaveTheirBlocks) {
  for (const char* word : {"resistance", "basal.resistance"})
    EXPECT_THAT(advice_on_foreign_word(word), HasSubstr("buildings terrain.buildings")) << word;
}

TEST(ForeignWords, LeaveOthersToTheKeyTable) {
  EXPECT_EQ(advice_on_foreign_word("basal.friction_coeficient"), "");
  EXPECT_EQ(advice_on_foreign_word(""), "");
}

TEST(IdleKeys, ThresholdsOfErodedDepthNeedErosion) {
  Scenario s = with_grains();
  EXPECT_THAT(idle_layer_keys(s), IsEmpty());
  s.hazard.eroded_depth_m = {0.3};
  EXPECT_THAT(idle_layer_keys(s), ElementsAre("hazard.eroded_depth_m"));
  s.erosion.emplace();
  EXPECT_THAT(idle_layer_keys(s), IsEmpty());
}

}  // namespace

}  // namespace sturz
