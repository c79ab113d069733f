// SPDX-License-Identifier: Apache-2.0
// What a user reads when the block `observation` of a scenario file is wrong.
#include "io/scenario/scenario_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string scene(const std::string& observation) {
  return "terrain: {raster: bed.tif}\n"
         "release: {thickness_raster: h.tif}\n"
         "numerics: {spacing_m: 5}\n"
         "grains: {friction_angle_deg: 24}\n"
         "observation:\n" +
         observation;
}

std::vector<std::string> problems(const std::string& observation) {
  try {
    read_scenario_text(scene(observation), "scenario.yaml");
  } catch (const ScenarioError& error) {
    return error.problems();
  }
  return {};
}

constexpr const char* everything =
    "  outline: mapped.gpkg\n"
    "  outline_sd_m: 10\n"
    "  deposit: deposit.gpkg\n"
    "  deposit_sd_m: 5\n"
    "  deposit_thickness: dod.tif\n"
    "  thickness_sign: fall_positive\n"
    "  thickness_sd_m: 0.5\n"
    "  farthest_point_m: [500000, 4600000]\n"
    "  farthest_point_sd_m: 20\n"
    "  runout_m: {value: 770, sd: 20}\n"
    "  h_over_l: {value: 0.3, sd: 0.02}\n"
    "  volume_m3: {value: 22000, sd: 2000}\n"
    "  fronts:\n"
    "    - {time_s: 12, distance_m: 300, sd_m: 20}\n"
    "    - {time_s: 30, point_m: [500100, 4600000], sd_s: 4}\n"
    "  speeds: [{point_m: [500100, 4600000], speed_m_s: 14, sd_m_s: 3}]\n"
    "  threshold_m: 0.2\n"
    "  thalweg: thalweg.gpkg\n";

TEST(ObservationMessages, ACompleteBlockIsGoodAndComesBackFromItsText) {
  EXPECT_THAT(problems(everything), ElementsAre());
  const Scenario s = read_scenario_text(scene(everything), "scenario.yaml");
  ASSERT_TRUE(s.observation);
  EXPECT_EQ(s.observation->fronts.size(), 2U);
  EXPECT_EQ(s.observation->fronts[1].at("point_m"), (std::vector<double>{500100, 4600000}));
  EXPECT_EQ(s.observation->thickness_sign, ThicknessSign::fall_positive);
  EXPECT_EQ(read_scenario_text(write_scenario(s, ""), "again.yaml").observation, s.observation);
}

TEST(ObservationMessages, EveryQuantityNeedsItsStandardDeviation) {
  EXPECT_THAT(
      problems("  outline: mapped.gpkg\n  runout_m: {value: 770}\n"
               "  farthest_point: toe.gpkg\n  deposit_sd_m: 5\n"
               "  fronts:\n    - {time_s: 3, distance_m: 5}\n"
               "  speeds:\n    - {point_m: [1, 2], speed_m_s: 9}\n"),
      ElementsAre(
          "scenario.yaml:6:12: observation.outline (without a standard deviation it cannot be "
          "weighed). Add outline_sd_m.",
          "scenario.yaml:7:13: observation.runout_m (without a standard deviation it cannot be "
          "weighed). Add sd.",
          "scenario.yaml:8:19: observation.farthest_point (without a standard deviation it cannot "
          "be weighed). Add farthest_point_sd_m.",
          "scenario.yaml:9:17: observation.deposit_sd_m (there is no deposit that it could belong "
          "to). Remove it.",
          "scenario.yaml:11:5: observation.fronts[0] (must say how well that is known, once). Give "
          "sd_m to compare places at the time, or sd_s to compare times at the place.",
          "scenario.yaml:13:7: observation.speeds[0] (sd_m_s is missing). Add it."));
}

TEST(ObservationMessages, UnlikeIsNotCompared) {
  EXPECT_THAT(problems("  deposit_thickness: h.tif\n  thickness_sd_m: 1\n  mask_erosion: false\n"),
              ElementsAre(HasSubstr("scenario.yaml:8:17: observation.mask_erosion = false "
                                    "(deposit_thickness holds thicknesses")));
  const std::string difference =
      "  deposit_thickness: h.tif\n  thickness_sd_m: 1\n  thickness_sign: rise_positive\n"
      "  mask_erosion: false\n";
  EXPECT_THAT(problems(difference), ElementsAre(HasSubstr("the scene has no erosion")));
  EXPECT_THAT(problems(difference + "erosion: {depth_m: 1, growth_rate_per_m: 0.001}\n"),
              ElementsAre());
  EXPECT_THAT(problems("  runout_m: {value: 7, sd: 1}\n  thickness_sign: rise_positive\n"),
              ElementsAre(HasSubstr("observation.thickness_sign (there is no deposit_thickness)")));
}

TEST(ObservationMessages, WhatSaysNothingOrTwice) {
  EXPECT_THAT(problems("  threshold_m: 0.2\n"),
              ElementsAre(StartsWith("scenario.yaml:6:3: observation (nothing is compared)")));
  EXPECT_THAT(problems("  farthest_point: a.gpkg\n  farthest_point_m: [1, 2]\n"
                       "  farthest_point_sd_m: 3\n"),
              ElementsAre(HasSubstr("observation.farthest_point_m (farthest_point names the "
                                    "point too)")));
  EXPECT_THAT(problems("  fronts:\n    - {time_s: 3, distance_m: 5, point_m: [1, 2], sd_m: 1}\n"),
              ElementsAre(HasSubstr("observation.fronts[0] (must say where the front was, once)")));
  EXPECT_THAT(problems("  volume_m3: {sd: 5}\n"),
              ElementsAre(HasSubstr("observation.volume_m3 (value is missing)")));
}

TEST(ObservationMessages, WordsAndNumbersOfLists) {
  EXPECT_THAT(problems("  speeds: [{point: [1, 2], speed_m_s: 9, sd_m_s: 1}]\n"),
              ElementsAre(HasSubstr("observation.speeds[0] (point_m is missing)"),
                          HasSubstr("observation.speeds[0].point (unknown key). Did you mean "
                                    "point_m?")));
  EXPECT_THAT(problems("  speeds: [{point_m: [1, 2, 3], speed_m_s: 9, sd_m_s: 1}]\n"),
              ElementsAre(HasSubstr("must be two numbers, [x, y]")));
  EXPECT_THAT(problems("  speeds: [{point_m: [1, 2], speed_m_s: 900, sd_m_s: 1}]\n"),
              ElementsAre(HasSubstr("observation.speeds[0].speed_m_s = 900 (must be in 0..500)")));
  EXPECT_THAT(problems("  speeds: [{point_m: [1, 2], speed_m_s: {normal: [5, 1]}, sd_m_s: 1}]\n"),
              ElementsAre(HasSubstr("must be a plain number")));
  EXPECT_THAT(problems("  fronts: {time_s: 3}\n"),
              ElementsAre(HasSubstr("must be a list of measurements")));
  EXPECT_THAT(problems("  outline_sd_m: 0\n  outline: a.gpkg\n"),
              ElementsAre(HasSubstr("observation.outline_sd_m = 0 (must be > 0")));
}

TEST(ObservationMessages, NumbersThatNoSlideHasAreRefusedAtTheirLine) {
  EXPECT_THAT(
      problems("  runout_m: {value: -770, sd: 20}\n"
               "  h_over_l: {value: 25, sd: 1}\n"
               "  com_travel_m: {value: 0, sd: 20}\n"),
      ElementsAre(AllOf(StartsWith("scenario.yaml:6:"), HasSubstr("runout_m.value = -770")),
                  AllOf(StartsWith("scenario.yaml:7:21: observation.h_over_l.value = 25"),
                        HasSubstr("its tangent is 0.466")),
                  AllOf(StartsWith("scenario.yaml:8:"), HasSubstr("com_travel_m.value = 0"))));
  EXPECT_THAT(problems("  h_over_l: {value: 2, sd: 0.1}\n"), ElementsAre());
  EXPECT_THAT(problems("  h_over_l: {value: 200, sd: 1}\n"),
              ElementsAre(AllOf(HasSubstr("steeper than 63 degrees"),
                                ::testing::Not(HasSubstr("tangent is")))));
}

}  // namespace
}  // namespace sturz
