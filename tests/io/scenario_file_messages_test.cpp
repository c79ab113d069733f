// SPDX-License-Identifier: Apache-2.0
// What a user reads when a scenario file is wrong, word for word.
#include "io/scenario/scenario_file.hpp"
#include "scenarios/schema/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> problems(const std::string& text) {
  try {
    read_scenario_text(text, "scenario.yaml");
  } catch (const ScenarioError& error) {
    return error.problems();
  }
  return {};
}

/// As a message names them: a key that is added changes no expectation here.
std::string names_of(const std::string& block) {
  std::string text;
  for (const std::string& name : names_in_block(block)) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// A good scenario in nine lines; `grains` and `more` stand in for its last lines.
std::string scene(const std::string& grains = "  friction_angle_deg: 24\n",
                  const std::string& more = "") {
  return "terrain: {raster: bed.tif}\n"
         "release:\n"
         "  thickness_raster: h.tif\n"
         "numerics: {spacing_m: 5}\n"
         "grains:\n" +
         grains + more;
}

TEST(ScenarioMessages, TheBaseSceneIsGood) { EXPECT_THAT(problems(scene()), ElementsAre()); }

TEST(ScenarioMessages, UnitMistake) {
  EXPECT_THAT(problems(scene("  friction_angle_deg: 240\n")),
              ElementsAre("scenario.yaml:6:23: grains.friction_angle_deg = 240 (must be in 0..60). "
                          "Was it in another unit?"));
  EXPECT_THAT(problems(scene() + "basal: {friction_coefficient: 24}\n"),
              ElementsAre("scenario.yaml:7:31: basal.friction_coefficient = 24 (must be in 0..2). "
                          "Was it an angle in degrees? tan 24 deg = 0.445."));
}

TEST(ScenarioMessages, StrengthInside) {
  EXPECT_THAT(problems(scene("  friction_angle_deg: 24\n  friction_cone: plane_strain\n"
                             "  pore_pressure_inside: true\n")),
              ElementsAre());
  EXPECT_THAT(
      problems(scene("  friction_angle_deg: 24\n  friction_cone: plane-strain\n")),
      ElementsAre(
          "scenario.yaml:7:18: grains.friction_cone = plane-strain (must be one of simple_shear, "
          "plane_strain). Did you mean plane_strain?"));
  EXPECT_THAT(
      problems(scene("  friction_angle_deg: 24\n  pore_pressure_inside: 0.3\n")),
      ElementsAre(
          "scenario.yaml:7:25: grains.pore_pressure_inside = 0.3 (must be true or false)."));
  EXPECT_THAT(
      problems(scene("  friction_angle_deg: 24\n  pore_pressure_inside: true\n",
                     "basal: {zones: [{polygon: a.shp, pore_pressure_ratio: 0.4}]}\n")),
      ElementsAre("scenario.yaml:7:25: grains.pore_pressure_inside = true "
                  "(basal.zones[0].pore_pressure_ratio changes it from place to place; inside, "
                  "one ratio holds for the whole scene). Keep one of them; "
                  "basal.pore_pressure_ratio acts in both places."));
}

TEST(ScenarioMessages, UnknownKey) {
  EXPECT_THAT(problems(scene() + "basal: {friction_coeficient: 0.3}\n"),
              ElementsAre("scenario.yaml:7:9: basal.friction_coeficient (unknown key). Did you "
                          "mean basal.friction_coefficient?"));
  EXPECT_THAT(problems(scene() + "friction_coefficient: 0.3\n"),
              ElementsAre("scenario.yaml:7:1: friction_coefficient (unknown key). Did you mean "
                          "basal.friction_coefficient?"));
  EXPECT_THAT(problems(scene() + "basal.restitution: 0.3\n"),
              ElementsAre("scenario.yaml:7:1: basal.restitution (unknown key: a dot stands between "
                          "blocks, not in a name). Write the blocks one inside the other."));
  EXPECT_THAT(problems(scene() + "domain: {gravity: 3}\n"),
              ElementsAre("scenario.yaml:7:10: domain.gravity (unknown key). Known in domain: "
                          "periodic, walls."));
}

TEST(ScenarioMessages, WordsOfOtherProgramsGetAnAnswer) {
  EXPECT_THAT(problems(scene() + "basal: {mu: 0.2, xi: 2000, tau0_pa: 70}\n"),
              ElementsAre("scenario.yaml:7:9: basal.mu (unknown key). Use "
                          "basal.friction_coefficient: the tangent of the bed's friction angle.",
                          "scenario.yaml:7:18: basal.xi (unknown key). Use "
                          "basal.turbulent_coefficient_m_s2: Voellmy's xi, in m/s2 (100 to 3000).",
                          "scenario.yaml:7:28: basal.tau0_pa (unknown key). Use "
                          "basal.yield_stress_pa with basal.viscosity_pa_s: a Bingham fluid."));
  EXPECT_THAT(problems(scene() + "entrainment: {polygon: a.shp}\nresistance: {polygon: b.shp}\n"),
              ElementsAre(HasSubstr("entrainment (unknown key). Use the block erosion:"),
                          HasSubstr("resistance (unknown key). Forest is friction: basal.zones")));
}

TEST(ScenarioMessages, StatesOfGrains) {
  const auto states = [](const std::string& text) {
    return problems(scene("  friction_angle_deg: 24\n  states: {" + text + "}\n"));
  };
  EXPECT_THAT(states("dilute: {}, ultradilute: {}"), ElementsAre());
  EXPECT_THAT(states("stress_mode: paper_switch"), ElementsAre());
  EXPECT_THAT(states("stress_mode: seed"),
              ElementsAre(HasSubstr("grains.states.stress_mode = seed (has a new name in this "
                                    "version). Write paper_switch.")));
  EXPECT_THAT(states("dilute: {restitution: 1.5}"),
              ElementsAre(HasSubstr("grains.states.dilute.restitution = 1.5")));
  EXPECT_THAT(
      states("max_fraction: 0.6"),
      ElementsAre(HasSubstr("grains.states.max_fraction = 0.6 (must be at least 0.02 above")));
  EXPECT_THAT(problems(scene("  friction_angle_deg: 24\n  states: {dilute: {}}\n") +
                       "formulation: depth_averaged\n"),
              ElementsAre(HasSubstr("grains.states (formulation is depth_averaged")));
}

TEST(ScenarioMessages, KeysOfLaterVersionsAreNotUnknown) {
  EXPECT_THAT(problems(scene() + "prior: {}\n"),
              ElementsAre("scenario.yaml:7:1: prior (not available in this version: ready-made "
                          "distributions by material). Remove it."));
  EXPECT_THAT(problems(scene() + "prior: {}\ncoupling: 1\nobservation: {}\n").size(), 3u);
  EXPECT_THAT(problems(scene() + "ensemble: {design: full_grid}\n"),
              ElementsAre("scenario.yaml:7:20: ensemble.design = full_grid (not available in this "
                          "version). Available: monte_carlo, latin_hypercube, sobol, table, "
                          "morris, saltelli."));
}

TEST(ScenarioMessages, DuplicateKey) {
  EXPECT_THAT(problems(scene() + "numerics: {spacing_m: 6}\n"),
              ElementsAre("scenario.yaml:7:1: numerics (stands here twice, first in line 4). Keep "
                          "one of them."));
}

TEST(ScenarioMessages, WrongType) {
  EXPECT_THAT(problems(scene("  friction_angle_deg: steep\n")),
              ElementsAre("scenario.yaml:6:23: grains.friction_angle_deg = steep (must be a number "
                          "or a distribution)."));
  EXPECT_THAT(problems(scene() + "numerics: [5]\n").size(), 1u);
  EXPECT_THAT(problems(scene() + "title: [a]\n"),
              ElementsAre("scenario.yaml:7:8: title = [a] (must be text)."));
  EXPECT_THAT(problems(scene() + "domain: {periodic: y}\n"),
              ElementsAre("scenario.yaml:7:20: domain.periodic = y (must be a list, [...])."));
  EXPECT_THAT(problems(scene() + "basal: 0.3\n"),
              ElementsAre("scenario.yaml:7:8: basal = 0.3 (must be a block of keys: " +
                          names_of("basal") + ")."));
  EXPECT_THAT(problems(scene() + "ensemble: {members: 3.5}\n"),
              ElementsAre("scenario.yaml:7:21: ensemble.members = 3.5 (must be a whole number)."));
  EXPECT_THAT(problems(scene() + "hazard: {cell_size_m: {uniform: [1, 2]}}\n"),
              ElementsAre("scenario.yaml:7:23: hazard.cell_size_m = {uniform: [1, 2]} (must be a "
                          "plain number). Only numbers of release, inflow, grains, basal, "
                          "mixture, fluid, coupling, erosion and dams can be uncertain."));
}

TEST(ScenarioMessages, NumbersAreStrict) {
  const auto at_basal = [](const std::string& value) {
    return problems(scene() + "basal:\n  restitution: " + value + "\n");
  };
  EXPECT_THAT(at_basal("0,2"), ElementsAre(HasSubstr("= 0,2 (must be a number or a distribution). "
                                                     "Use a decimal point: 0.2.")));
  EXPECT_THAT(at_basal(".nan"), ElementsAre(HasSubstr("It must be finite.")));
  EXPECT_THAT(at_basal("NaN"), ElementsAre(HasSubstr("It must be finite.")));
  EXPECT_THAT(at_basal("-inf"), ElementsAre(HasSubstr("It must be finite.")));
  EXPECT_THAT(at_basal("0x1"), ElementsAre(HasSubstr("Write it in decimal.")));
  EXPECT_THAT(at_basal("0.5m"), ElementsAre(HasSubstr("Write the number alone")));
  EXPECT_THAT(at_basal("20 %"), ElementsAre(HasSubstr("fraction between 0 and 1")));
  EXPECT_THAT(at_basal("\"0.5\""), ElementsAre(HasSubstr("Remove the quotes.")));
  EXPECT_THAT(at_basal("1e999"), ElementsAre(HasSubstr("= 1e999 (must be a number")));
  EXPECT_THAT(at_basal("NO"), ElementsAre(HasSubstr("= NO (must be a number")));
  EXPECT_THAT(at_basal("1_0"), ElementsAre(HasSubstr("= 1_0 (must be a number")));
}

TEST(ScenarioMessages, WordsStayWords) {
  EXPECT_EQ(read_scenario_text(scene() + "title: NO\n", "s").title, "NO");
  EXPECT_EQ(read_scenario_text(scene() + "title: 0123\n", "s").title, "0123");
  EXPECT_THAT(problems(scene() + "numerics2: 1\n").size(), 1u);
}

TEST(ScenarioMessages, BadDistribution) {
  const auto at_basal = [](const std::string& value) {
    return problems(scene() + "basal: {restitution: " + value + "}\n");
  };
  EXPECT_THAT(at_basal("{uniform: [0.5, 0.2]}"),
              ElementsAre("scenario.yaml:7:22: basal.restitution = {uniform: [0.5, 0.2]} (max must "
                          "be above min)."));
  EXPECT_THAT(at_basal("{unifrom: [0.1, 0.2]}"),
              ElementsAre("scenario.yaml:7:23: basal.restitution = {unifrom: ...} (unknown "
                          "distribution). Did you mean uniform?"));
  EXPECT_THAT(at_basal("{uniform: [0.1]}"),
              ElementsAre("scenario.yaml:7:32: basal.restitution.uniform = [0.1] (must be [min, "
                          "max] or {min, max})."));
  EXPECT_THAT(at_basal("{normal: {mean: 0.3, min: 0, max: 0.9}}"),
              ElementsAre("scenario.yaml:7:31: basal.restitution.normal (sd is missing). It takes "
                          "{mean, sd}, optional min, max."));
  EXPECT_THAT(at_basal("{beta: {alpa: 4, beta: 3, min: 0, max: 0.6}}"),
              ElementsAre(HasSubstr("(alpha is missing)"), HasSubstr("Did you mean alpha?")));
  EXPECT_THAT(at_basal("{truncated_normal: {mean: 0.3, sd: 0.1}}"),
              ElementsAre(HasSubstr("(min is missing)"), HasSubstr("(max is missing)")));
  EXPECT_THAT(at_basal("{triangular: [0, x, 0.9]}"), ElementsAre(HasSubstr("= x (must be a list")));
  EXPECT_THAT(at_basal("{uniform: [0, 1], normal: 3}"), ElementsAre(HasSubstr("one distribution")));
  EXPECT_THAT(at_basal("{table: 3}"), ElementsAre(HasSubstr("(must be [observation")));
}

TEST(ScenarioMessages, AbsentValuesStandAtTheirKey) {
  EXPECT_THAT(problems(scene("  friction_angle_deg:\n  cohesion_pa: 0\n")),
              ElementsAre("scenario.yaml:6:3: grains.friction_angle_deg (has no value; must be a "
                          "number or a distribution). Give it one or remove the key."));
  EXPECT_THAT(problems(scene() + "basal:\n\n\n"),
              ElementsAre("scenario.yaml:7:1: basal (has no keys). Give it some of " +
                          names_of("basal") + ", or remove it."));
}

TEST(ScenarioMessages, AllProblemsComeTogetherInFileOrder) {
  const auto found = problems(
      "terrain: {raster: bed.tif, nodata: lava}\n"
      "relase: {thickness_raster: h.tif}\n"
      "grains: {friction_angle_deg: 240, diameter_m: big}\n"
      "numerics: {spacing_m: -5, courant: 0.25}\n");
  EXPECT_THAT(
      found,
      ElementsAre("scenario.yaml: release (no source given). Add one of polygon, "
                  "thickness_raster, box, paraboloid, cylinder, or an inflow.",
                  "scenario.yaml:1:36: terrain.nodata = lava (must be one of outflow, wall).",
                  "scenario.yaml:2:1: relase (unknown key). Did you mean release?",
                  "scenario.yaml:3:30: grains.friction_angle_deg = 240 (must be in 0..60). Was it "
                  "in another unit?",
                  "scenario.yaml:3:47: grains.diameter_m = big (must be a number or a "
                  "distribution).",
                  "scenario.yaml:4:23: numerics.spacing_m = -5 (must be > 0 and <= 1000)."));
}

TEST(ScenarioMessages, OneMistakeIsReportedOnce) {
  // A wrong thickness must not also count as a missing one.
  EXPECT_THAT(problems("terrain: {raster: b.tif}\n"
                       "release: {box: {x_m: [0, 1], y_m: [0, 1]}, thickness_m: -3}\n"
                       "grains: {friction_angle_deg: 24}\nnumerics: {spacing_m: 5}\n"),
              ElementsAre(HasSubstr("release.thickness_m = -3 (must be > 0 and <= 2000).")));
  // Nor a misread distribution as a missing partner of a correlation.
  EXPECT_THAT(problems(scene() + "basal: {friction_coefficient: {uniform: 3}, "
                                 "pore_pressure_ratio: {uniform: [0, 0.5]}}\n"
                                 "ensemble: {correlation: "
                                 "{basal.friction_coefficient/basal.pore_pressure_ratio: 0.2}}\n")
                  .size(),
              1u);
  EXPECT_THAT(problems(scene() + "ensemble: {members: 99999999999}\n"),
              ElementsAre("scenario.yaml:7:21: ensemble.members = 99999999999 (must be in "
                          "1..10000000)."));
}

/// A scene whose basal.zones are `text`.
std::vector<std::string> zone_problems(const std::string& text) {
  return problems(scene() + "basal: {zones: " + text + "}\n");
}

TEST(ScenarioMessages, Zones) {
  EXPECT_THAT(zone_problems("[{polygon: a.gpkg, layer: b, friction_coefficient: 0.3}]"),
              ElementsAre());
  EXPECT_THAT(zone_problems("[]"), ElementsAre());
  EXPECT_THAT(zone_problems("{polygon: a.gpkg, cohesion_pa: 0}"),
              ElementsAre("scenario.yaml:7:16: basal.zones = {polygon: a.gpkg, cohesion_pa: 0} "
                          "(must be a list of zones, [{polygon: .., friction_coefficient: ..}])."));
  EXPECT_THAT(zone_problems("[a.gpkg]"),
              ElementsAre("scenario.yaml:7:17: basal.zones[0] = a.gpkg (must be a zone, {polygon: "
                          "plate.gpkg, friction_coefficient: 0.3})."));
  EXPECT_THAT(zone_problems("[{friction_coefficient: 0.3}]"),
              ElementsAre("scenario.yaml:7:16: basal.zones[0] (polygon is missing). Name the file "
                          "that outlines the zone."));
  EXPECT_THAT(zone_problems("[{polygon: a.gpkg}]"),
              ElementsAre("scenario.yaml:7:16: basal.zones[0] (gives no value). Give it some of "
                          "friction_coefficient, pore_pressure_ratio, cohesion_pa, "
                          "turbulent_coefficient_m_s2."));
  EXPECT_THAT(zone_problems("[{polygon: a.gpkg, pore_pressure_ratio: 1}]"),
              ElementsAre("scenario.yaml:7:16: basal.zones[0].pore_pressure_ratio = 1 (must be in "
                          "0..0.99)."));
}

TEST(ScenarioMessages, NamesAndTextsOfZones) {
  EXPECT_THAT(zone_problems("[{polygon: a.gpkg, friction_coeficient: 0.3}]"),
              ElementsAre("scenario.yaml:7:35: basal.zones[0].friction_coeficient (unknown key). "
                          "Did you mean friction_coefficient?"));
  EXPECT_THAT(
      zone_problems("[{polygon: a.gpkg, cohesion_pa: 5}, {polygon: b.gpkg, restitution: 0}]"),
      ElementsAre("scenario.yaml:7:70: basal.zones[1].restitution (unknown key). Known "
                  "here: polygon, layer, friction_coefficient, pore_pressure_ratio, "
                  "cohesion_pa, turbulent_coefficient_m_s2."));
  EXPECT_THAT(zone_problems("[{polygon: \"\", cohesion_pa: 5}]"),
              ElementsAre("scenario.yaml:7:27: basal.zones[0].polygon = \"\" (must be a file "
                          "name). Give it one or remove the key."));
  EXPECT_THAT(zone_problems("[{polygon: a.gpkg, layer: [b], cohesion_pa: 5}]"),
              ElementsAre("scenario.yaml:7:42: basal.zones[0].layer = [b] (must be text)."));
}

TEST(ScenarioMessages, ValuesOfZonesMayBeUncertain) {
  EXPECT_THAT(zone_problems("[{polygon: a.gpkg, friction_coefficient: {uniform: [0.2, 0.4]}}]"),
              ElementsAre());
  EXPECT_THAT(
      zone_problems("[{polygon: a.gpkg, friction_coefficient: {uniform: [0.2, 4]}}]"),
      ElementsAre("scenario.yaml:7:16: basal.zones[0].friction_coefficient = {uniform: "
                  "[0.2, 4]} (its values reach from 0.2 to 4 but must be in 0..2). Was it an angle "
                  "in degrees? tan 4 deg = 0.07."));
  EXPECT_THAT(zone_problems("[{polygon: a.gpkg, turbulent_coefficient_m_s2: 0}]"),
              ElementsAre("scenario.yaml:7:16: basal.zones[0].turbulent_coefficient_m_s2 = 0 "
                          "(must be > 0). Was it in another unit?"));
  EXPECT_THAT(zone_problems("[{polygon: a.gpkg, cohesion_pa: soft}]"),
              ElementsAre("scenario.yaml:7:48: basal.zones[0].cohesion_pa = soft (must be a "
                          "number or a distribution)."));
}

TEST(ScenarioMessages, KeysOfColumnsInFullStress) {
  EXPECT_THAT(problems(scene() + "formulation: full_stress\nbasal: {viscosity_pa_s: 100}\n"),
              ElementsAre("scenario.yaml:8:25: basal.viscosity_pa_s = 100 (formulation is "
                          "full_stress; only depth_averaged knows it). Remove it or set "
                          "formulation: depth_averaged."));
  // A misread viscosity must not also count as a missing one.
  EXPECT_THAT(problems(scene() + "basal: {viscosity_pa_s: thick, yield_stress_pa: 10}\n"),
              ElementsAre("scenario.yaml:7:25: basal.viscosity_pa_s = thick (must be a number or a "
                          "distribution)."));
}

TEST(ScenarioMessages, SyntheticTerrain) {
  const auto with = [](const std::string& terrain) {
    return problems("terrain: {synthetic: " + terrain +
                    "}\ngrains: {friction_angle_deg: 24}\nnumerics: {spacing_m: 5}\n"
                    "release: {box: {x_m: [0, 1], y_m: [0, 1]}, thickness_m: 3}\n");
  };
  EXPECT_THAT(with("{plane: {cell_size_m: 5}}"), ElementsAre());
  EXPECT_THAT(with("{plain: {cell_size_m: 5}}"), ElementsAre(HasSubstr("Did you mean plane?")));
  EXPECT_THAT(with("{plane: {}}"), ElementsAre(HasSubstr("(cell_size_m is missing)")));
  EXPECT_THAT(with("plane"), ElementsAre(HasSubstr("(must be one shape, {plane:")));
  EXPECT_THAT(with("{plane: {cell_size_m: 5, slope_deg: 95}}"),
              ElementsAre("scenario.yaml:1:22: terrain.synthetic.plane.slope_deg = 95 (must be in "
                          "0..80). Was it in another unit?"));
}

}  // namespace
}  // namespace sturz
