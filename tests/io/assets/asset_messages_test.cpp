// SPDX-License-Identifier: Apache-2.0
// What a user reads when the block `assets` of a scenario file is wrong.
#include "io/scenario/scenario_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string scene(const std::string& assets) {
  return "terrain: {raster: bed.tif}\n"
         "release: {thickness_raster: h.tif}\n"
         "numerics: {spacing_m: 5}\n"
         "grains: {friction_angle_deg: 24}\n"
         "assets:\n" +
         assets;
}

std::vector<std::string> problems(const std::string& assets) {
  try {
    read_scenario_text(scene(assets), "scenario.yaml");
  } catch (const ScenarioError& error) {
    return error.problems();
  }
  return {};
}

constexpr const char* everything =
    "  features: houses.gpkg\n"
    "  layer: buildings\n"
    "  name_attribute: id\n"
    "  class_attribute: type\n"
    "  vulnerability: curves.yaml\n"
    "  value_attribute: worth\n"
    "  value_unit: CHF\n"
    "  crs: EPSG:2056\n";

TEST(AssetMessages, ACompleteBlockIsGoodAndComesBackFromItsText) {
  EXPECT_THAT(problems(everything), ElementsAre());
  const Scenario s = read_scenario_text(scene(everything), "scenario.yaml");
  ASSERT_TRUE(s.assets);
  EXPECT_EQ(s.assets->value_unit, "CHF");
  EXPECT_EQ(read_scenario_text(write_scenario(s, ""), "again.yaml").assets, s.assets);
  EXPECT_THAT(problems("  features: houses.gpkg\n  name_attribute: id\n"), ElementsAre());
}

TEST(AssetMessages, WhatBelongsTogetherIsAskedFor) {
  EXPECT_THAT(problems("  name_attribute: id\n"),
              ElementsAre(HasSubstr("assets (names no layer)")));
  EXPECT_THAT(problems("  features: houses.gpkg\n"),
              ElementsAre(HasSubstr("Add assets.name_attribute")));
  const std::string good = "  features: houses.gpkg\n  name_attribute: id\n";
  EXPECT_THAT(problems(good + "  class_attribute: type\n"),
              ElementsAre(HasSubstr("assets.class_attribute (a class says nothing without its "
                                    "curve). Add assets.vulnerability or remove it.")));
  EXPECT_THAT(problems(good + "  vulnerability: curves.yaml\n"),
              ElementsAre(HasSubstr("Add assets.class_attribute or remove it.")));
  EXPECT_THAT(problems(good + "  value_attribute: worth\n"),
              ElementsAre(HasSubstr("(a number without a unit). Add assets.value_unit")));
  EXPECT_THAT(problems(good + "  value_unit: CHF\n"),
              ElementsAre(HasSubstr("Add assets.value_attribute or remove it.")));
  EXPECT_THAT(problems(good + "  value_attribute: worth\n  value_unit: 1000 CHF\n"),
              ElementsAre(HasSubstr("assets.value_unit = 1000 CHF (it ends the names of columns")));
}

}  // namespace
}  // namespace sturz
