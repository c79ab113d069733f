// SPDX-License-Identifier: Apache-2.0
// `material`: priors for what the file does not say.
#include "io/scenario/scenario_file.hpp"
#include "scenarios/materials/materials.hpp"
#include "scenarios/schema/schema.hpp"
#include "scenarios/schema/value_text.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

std::string slope(const std::string& more) {
  return "terrain: {synthetic: {plane: {slope_deg: 30, cell_size_m: 2}}}\n"
         "release: {box: {x_m: [20, 40], y_m: [-10, 10]}, thickness_m: 2}\n"
         "numerics: {spacing_m: 2}\n" +
         more;
}

Scenario read(const std::string& more, const std::vector<std::string>& overrides = {}) {
  return read_scenario_text(slope(more), "scene.yaml", {}, overrides);
}

std::string refusal(const std::string& more) {
  try {
    read(more);
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(Materials, EachGivesItsValuesAndTellsTheirSource) {
  for (const Material& material : materials()) {
    const Scenario scenario = read(fmt::format("material: {}\n", material.name));
    for (const MaterialValue& value : material.values)
      EXPECT_EQ(value_text(find_key(value.key)->get(scenario)), value.value) << value.key;
    const auto notes = material_notes(scenario);
    EXPECT_THAT(notes, SizeIs(material.values.size()));
    EXPECT_THAT(notes, Each(Not(HasSubstr("yours"))));
    for (std::size_t i = 0; i < notes.size(); ++i)
      EXPECT_THAT(notes[i], HasSubstr(material.values[i].source));
  }
}

TEST(Materials, AMisspeltOneIsTheOnlyProblem) {
  for (const char* name : {"rockavalanche", "Debris_flow"}) {
    const std::string said = refusal(fmt::format("material: {}\n", name));
    EXPECT_THAT(said, HasSubstr(fmt::format("material = {}", name)));
    EXPECT_THAT(said, Not(HasSubstr("grains (missing")));
  }
  EXPECT_THAT(refusal(""), HasSubstr("Add a grains block or a material, or a fluid."));
}

TEST(Materials, AStoredSceneReadsBackAsItWas) {
  const Scenario scenario = read("material: snow_wet\n");
  EXPECT_EQ(read_scenario_text(write_scenario(scenario), "stored.yaml"), scenario);
}

TEST(Materials, WhatTheFileOrTheCommandSaysHolds) {
  const Scenario scenario =
      read("material: rock_avalanche\nbasal: {friction_coefficient: 0.2}\n",
           {"basal.turbulent_coefficient_m_s2={uniform: [300, 400]}", "grains.density_kg_m3=2700"});
  EXPECT_EQ(scenario.basal.friction_coefficient.value, 0.2);
  EXPECT_EQ(scenario.grains->density_kg_m3.value, 2700);
  EXPECT_EQ(scenario.basal.turbulent_coefficient_m_s2->distribution->max, 400);
  const auto notes = material_notes(scenario);
  EXPECT_THAT(notes[2], HasSubstr("basal.friction_coefficient = 0.2 (yours; the material's is "
                                  "{triangular: [0.03, 0.1, 0.25]}"));
  EXPECT_THAT(notes[1], HasSubstr("from memory"));
}

TEST(Materials, WithoutTheKeyNothingChanges) {
  const std::string grains = "grains: {density_kg_m3: 2600}\n";
  const Scenario bare = read(grains);
  EXPECT_EQ(bare, read(grains + "material: lahar\n", {"material=null"}));
  EXPECT_TRUE(material_notes(bare).empty());
}

TEST(Materials, WrongOnesAreRefusedWithWhatIsKnown) {
  EXPECT_THAT(refusal("material: rock_avalance\n"),
              HasSubstr("scene.yaml:4:11: material = rock_avalance (must be one of "
                        "rock_avalanche, debris_flow, mud_flow, snow_dense, snow_wet, lahar). Did "
                        "you mean rock_avalanche?"));
  EXPECT_THAT(refusal("material: [lahar]\n"), HasSubstr("scene.yaml:4:11: material"));
}

TEST(Materials, AreForColumns) {
  const std::string said = refusal("material: rock_avalanche\nformulation: full_stress\n");
  EXPECT_THAT(said, HasSubstr("scene.yaml:4:11: material = rock_avalanche (formulation is "
                              "full_stress; its priors are those of columns). Remove it or set"));
  EXPECT_THAT(said, Not(HasSubstr("basal.turbulent_coefficient_m_s2")))
      << "what the file does not say cannot be removed from it";
}

}  // namespace
}  // namespace sturz
