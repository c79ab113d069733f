// SPDX-License-Identifier: Apache-2.0
// What the terminal and its JSON say of members whose end was not seen.
#include "tests/app/app_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class CensoringWords : public App {
 protected:
  CensoringWords() {
    write("scene.yaml",
          replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged"));
  }
  Ended ensemble(std::vector<std::string> more) const {
    std::vector<std::string> all{"ensemble", path("scene.yaml"), "-o", path("out")};
    all.insert(all.end(), more.begin(), more.end());
    return sturz(all);
  }
};

TEST_F(CensoringWords, CountsMembersThatTheEndTimeCut) {
  const Ended ended = ensemble({"--set", "numerics.end_time_s=1"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("6 of 6 members are valid: 6 out of time."));
  EXPECT_THAT(ended.err, HasSubstr("6 of 6 simulations (100 %) are cut off."));
  EXPECT_THAT(ended.err, HasSubstr("longer numerics.end_time_s"));
  EXPECT_THAT(ended.err, Not(HasSubstr("terrain.raster")));
}

TEST_F(CensoringWords, CountsMembersThatLeftTheTerrainAndSaysWhere) {
  const Ended ended =
      ensemble({"--json", "--set", "basal.friction_coefficient=0", "--set",
                "basal.pore_pressure_ratio=0", "--set", "numerics.end_time_s=60", "-n", "2"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto censoring = event(ended, "done").value("censoring", nlohmann::json::object());
  EXPECT_EQ(censoring.value("members", 0), 2);
  EXPECT_EQ(censoring.value("left_terrain", 0) + censoring.value("left_and_moving", 0), 2);
  EXPECT_EQ(censoring.value("fraction", 0.0), 1.0);
  EXPECT_NEAR(censoring.value("largest_lost_fraction", 0.0), 1.0, 1e-9);
  EXPECT_TRUE(censoring.value("too_many", false));
  EXPECT_EQ(censoring.value("max_censored_fraction", 0.0), 0.05);
}

TEST_F(CensoringWords, AcceptsTheShareThatTheScenarioAccepts) {
  const Ended ended =
      ensemble({"--set", "numerics.end_time_s=1", "--set", "ensemble.max_censored_fraction=1"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, Not(HasSubstr("warning: 6 of 6 simulations"))) << "a note, no warning";
  EXPECT_THAT(read("out/report.html"), Not(HasSubstr("<section class=\"banner\"")));
}

TEST_F(CensoringWords, ARunMarksWhatIsALowerBound) {
  const Ended ended =
      sturz({"run", path("scene.yaml"), "-o", path("run"), "--set", "numerics.end_time_s=1"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("runout                >= "));
  EXPECT_THAT(ended.out, HasSubstr(" so far"));
  EXPECT_THAT(ended.err, HasSubstr("This result is cut off."));
  EXPECT_THAT(read("run/report.html"), HasSubstr("<section class=\"banner\""));
}

TEST_F(CensoringWords, ARunMarksWhatItErodedAndItsPorePressureToo) {
  const auto run = [&](const char* end_time) {
    const Ended ended = sturz(
        {"run", path("scene.yaml"), "-o", path("run"), "--replace", "--set",
         "basal.pore_pressure_ratio=0", "--set", "mixture.permeability_m2=1e-9", "--set",
         "erosion.growth_rate_per_m=0.01", "--set", "erosion.depth_m=0.1", "--set", end_time});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return ended.out;
  };
  const std::string cut = run("numerics.end_time_s=1");
  EXPECT_THAT(cut, ContainsRegex("erosion  +>= [0-9.]+ m3 of the bed, up to >= 0[.][0-9]+ m deep; "
                                 "by mass the flow grew >= 1[.][0-9]+ times"));
  EXPECT_THAT(cut, ContainsRegex("pore pressure  +>= [0-9.]+ % of the weight at most, [0-9.]+ % so "
                                 "far at the end"));
  EXPECT_THAT(cut, ContainsRegex("solid fraction  +0[.][0-9]+ so far at the end"));
  EXPECT_THAT(cut, ContainsRegex("largest speed  +>= [0-9.]+ m/s"));
  EXPECT_THAT(cut, ContainsRegex("largest energy  +>= [0-9.]+ kJ/m2, pressure >= [0-9.]+ kPa"));
}

TEST_F(CensoringWords, WhatHasNoValueIsNotKnownAndColumnsAreNoParticles) {
  const Ended ended = sturz({"run", path("scene.yaml"), "-o", path("run"), "--set",
                             "basal.friction_coefficient=0.05", "--set", "numerics.end_time_s=60"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  ASSERT_THAT(ended.out, HasSubstr("left the terrain"));
  EXPECT_THAT(ended.out, HasSubstr("H not known, H/L not known"));
  EXPECT_THAT(ended.out, Not(HasSubstr("none")));
  EXPECT_THAT(ended.out, HasSubstr("\n  columns               "));
  EXPECT_THAT(ended.out, Not(HasSubstr("\n  particles ")));
}

}  // namespace
}  // namespace sturz::test
