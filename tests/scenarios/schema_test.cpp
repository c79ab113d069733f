// SPDX-License-Identifier: Apache-2.0
#include "scenarios/schema/schema.hpp"

#include "engine/core/error.hpp"
#include "scenarios/checks/validate.hpp"
#include "scenarios/schema/zone_fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace sturz {
namespace {

using ::testing::ElementsAre;

/// A value of the key's own kind that differs from every default and lies in its range.
KeyValue unusual_value(const KeyInfo& key) {
  const double middle = std::isfinite(key.max) && std::isfinite(key.min)
                            ? key.min + 0.37 * (key.max - key.min)
                            : 12.375;
  switch (key.kind) {
    case ValueKind::number:
      return middle;
    case ValueKind::integer:
      return key.max < 77 ? static_cast<std::int64_t>(middle) : 77;
    case ValueKind::text:
    case ValueKind::path:
      return std::string("unusual");
    case ValueKind::choice:
      return key.choices.back();
    case ValueKind::flag: {
      const KeyValue given = key.get(Scenario{});  // none in a block that is absent
      const bool* flag = std::get_if<bool>(&given);
      return flag == nullptr || !*flag;
    }
    case ValueKind::uncertain: {
      Uncertain u;
      u.distribution = Distribution{};
      u.distribution->min = std::min(middle, middle * 1.01);
      u.distribution->max = std::max(middle, middle * 1.01);
      return u;
    }
    case ValueKind::number_list:
      return std::vector<double>(key.list_size == 0 ? 4 : key.list_size, middle);
    case ValueKind::text_list:
      return std::vector<std::string>{key.choices.back()};
    case ValueKind::number_map:
      return std::map<std::string, double>{{"a/b", 0.5}};
    case ValueKind::path_map:
      return std::map<std::string, std::string>{{"Roads", "roads.gpkg"}};
    case ValueKind::synthetic:
      return SyntheticTerrain{"ramp", 2, {{"slope_deg", 20}}};
    case ValueKind::wall_list:
      return std::vector<WallSpec>{{{1, 2, 3}, {0, 1, 0}, 0.3, 4.0}};
    case ValueKind::dam_list: {
      DamSpec dam;
      dam.line = "unusual.gpkg";
      dam.height_m = Uncertain(7);
      dam.crest_width_m = 5;
      return std::vector<DamSpec>{dam};
    }
    case ValueKind::zone_list:
      return std::vector<BasalZone>{{"unusual.gpkg", "plate", 0.3, {}, 50.0}};
    case ValueKind::inflow_list: {
      InflowSpec source;
      source.hydrograph = "unusual.csv";
      source.line_m = {{1, 2}, {3, 4}};
      source.discharge_factor = 1.5;
      return std::vector<InflowSpec>{source};
    }
    case ValueKind::gauge_points:
      return std::vector<GaugeSpec>{{"bridge", {{{1, 2}}}}};
    case ValueKind::gauge_lines:
      return std::vector<GaugeSpec>{{"road", {{{1, 2}}, {{3, 4}}}}};
    case ValueKind::record_list: {
      NumberRecord record;
      for (const RecordField& field : key.fields)
        record[field.name].assign(field.size, (field.min + field.max) / 2);
      return std::vector<NumberRecord>{record};
    }
  }
  return {};
}

TEST(Schema, EveryKeyGivesBackWhatWasSet) {
  for (const auto& key : schema()) {
    Scenario s;
    const KeyValue value = unusual_value(key);
    key.set(s, value);
    EXPECT_EQ(key.get(s), value) << key.path;
    Scenario untouched;
    if (key.choices.size() != 1) {
      EXPECT_NE(s, untouched) << key.path << " does not reach the scenario";
    }
    EXPECT_TRUE(check_value(key, value).empty()) << key.path;
  }
}

TEST(Schema, EveryKeyHasAHelpSentenceAndSaneLimits) {
  std::set<std::string> paths;
  for (const auto& key : schema()) {
    EXPECT_TRUE(paths.insert(key.path).second) << key.path << " stands there twice";
    EXPECT_GT(key.help.size(), 15u) << key.path;
    EXPECT_EQ(key.help.back(), '.') << key.path;
    EXPECT_LT(key.min, key.max) << key.path;
    EXPECT_EQ(find_key(key.path), &key);
    EXPECT_EQ(key.kind == ValueKind::choice || key.kind == ValueKind::text_list,
              !key.choices.empty())
        << key.path;
  }
}

TEST(Schema, DefaultsLieInsideTheLimits) {
  Scenario s;
  s.grains.emplace().friction.emplace();
  for (const auto& key : schema())
    for (const auto& problem : check_value(key, key.get(s))) ADD_FAILURE() << problem.message;
}

TEST(Schema, UnitsStandInTheNames) {
  const std::map<std::string, std::string> tails = {
      {"m", "_m"},          {"m3", "_m3"},        {"s", "_s"},
      {"degree", "_deg"},   {"Pa", "_pa"},        {"kPa", "_kpa"},
      {"m s-1", "_m_s"},    {"kJ m-2", "_kj_m2"}, {"kg m-3", "_kg_m3"},
      {"m s-2", "_m_s2"},   {"Pa s", "_pa_s"},    {"m2", "_m2"},
      {"Pa s^n", "_pa_sn"}, {"m-1", "_per_m"},    {"m kPa-1", "_m_per_kpa"},
      {"h", "_hours"}};
  for (const auto& key : schema()) {
    if (key.units.empty() || key.units == "1") continue;
    ASSERT_TRUE(tails.count(key.units)) << key.path << " [" << key.units << "]";
    // A measured number and its standard deviation stand in a block that says the unit of both.
    std::string named = key.path;
    for (const char* part : {".value", ".sd"})
      if (named.ends_with(part)) named.resize(named.rfind('.'));
    EXPECT_TRUE(named.ends_with(tails.at(key.units))) << key.path << " [" << key.units << "]";
  }
}

TEST(Schema, OnlyPhysicalQuantitiesMayBeUncertain) {
  for (const auto& key : schema())
    if (key.kind == ValueKind::uncertain) {
      EXPECT_TRUE(key.path.starts_with("release.") || key.path.starts_with("grains.") ||
                  key.path.starts_with("basal.") || key.path.starts_with("mixture.") ||
                  key.path.starts_with("fluid.") || key.path.starts_with("coupling.") ||
                  key.path.starts_with("erosion."))
          << key.path;
    }
}

TEST(Schema, BlocksAreKnownByTheirKeys) {
  EXPECT_TRUE(is_block("grains"));
  EXPECT_TRUE(is_block("grains.friction"));
  EXPECT_FALSE(is_block("grains.density_kg_m3"));
  EXPECT_FALSE(is_block("grain"));
  EXPECT_THAT(names_in_block("grains.friction"),
              ElementsAre("static", "dynamic", "inertial_number_scale"));
  EXPECT_THAT(
      names_in_block(""),
      ElementsAre("title", "terrain", "release", "inflow", "material", "grains", "mixture", "fluid",
                  "coupling", "basal", "formulation", "erosion", "numerics", "domain", "ensemble",
                  "hazard", "gauges", "observation", "assets", "report"));
  for (const auto& block : optional_blocks()) {
    Scenario s;
    EXPECT_FALSE(block.present(s)) << block.path;
    block.make(s);
    EXPECT_TRUE(block.present(s)) << block.path;
  }
}

TEST(Schema, LaterKeysAreNoKeysYet) {
  for (const auto& later : later_keys()) {
    EXPECT_EQ(find_key(later.path), nullptr) << later.path;
    EXPECT_FALSE(is_block(later.path)) << later.path;
  }
}

TEST(Schema, EveryFileNameOfAValueIsFound) {
  Scenario s;
  s.terrain.raster = "bed.tif";
  s.release.layer = "no file";
  s.ensemble.table = "design.csv";
  s.basal.zones = {{"plate.gpkg", "a", 0.3, {}, {}}, {"ice.gpkg", "", 0.1, {}, {}}};
  std::vector<std::string> files;
  for (const auto& key : schema()) {
    KeyValue value = key.get(s);
    for_each_path(key, value, [&](std::string& path) {
      files.push_back(path);
      path = "x";
    });
    if (!std::holds_alternative<std::monostate>(value)) key.set(s, value);
  }
  EXPECT_THAT(files, ElementsAre("bed.tif", "plate.gpkg", "ice.gpkg", "design.csv"));
  EXPECT_EQ(s.terrain.raster, "x");
  EXPECT_EQ(s.basal.zones[1].polygon, "x");
  EXPECT_EQ(s.basal.zones[0].layer, "a");
}

TEST(Schema, AZonesNumbersShareTheRowsOfTheBed) {
  for (const auto& field : zone_fields) {
    EXPECT_EQ(find_zone_field(field.name), &field);
    ASSERT_NE(find_key(std::string("basal.") + field.name), nullptr) << field.name;
    EXPECT_EQ(basal_key(field).kind, ValueKind::uncertain) << field.name;
  }
  EXPECT_EQ(find_zone_field("restitution"), nullptr);
}

TEST(Schema, TheFormulationIsChosenByTheProgramUnlessSaid) {
  const KeyInfo* key = find_key("formulation");
  EXPECT_EQ(key->get(Scenario{}), KeyValue{std::string("auto")});
  EXPECT_THAT(key->choices, ElementsAre("auto", "full_stress", "depth_averaged", "discrete"));
  EXPECT_TRUE(key->later_choices.empty());
}

TEST(Schema, UncertainKeysComeInTableOrder) {
  Scenario s;
  Uncertain u;
  u.distribution = Distribution{};
  u.distribution->min = 0.1;
  u.distribution->max = 0.2;
  s.basal.friction_coefficient = u;
  s.grains.emplace().solid_fraction = u;
  const auto keys = uncertain_keys(s);
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0].path, "grains.solid_fraction");
  EXPECT_EQ(keys[1].path, "basal.friction_coefficient");
  EXPECT_EQ(keys[1].distribution, *u.distribution);
  EXPECT_EQ(keys[1].units, "1");
}

TEST(Schema, WithValueReplacesADistribution) {
  Scenario s;
  s.basal.friction_coefficient.distribution = Distribution{};
  const Scenario fixed = with_value(s, "basal.friction_coefficient", 0.3);
  EXPECT_EQ(fixed.basal.friction_coefficient, Uncertain(0.3));
  EXPECT_TRUE(uncertain_keys(fixed).empty());
  EXPECT_EQ(with_value(s, "numerics.spacing_m", 4).numerics.spacing_m, 4);
}

TEST(Schema, NumbersOfZonesMayBeUncertain) {
  Uncertain u;
  u.distribution = Distribution{};
  u.distribution->min = 200;
  u.distribution->max = 400;
  Scenario s;
  s.basal.zones = {{"ice.gpkg", "", 0.1, {}, {}}, {"forest.gpkg", "", 0.3, {}, {}, u}};
  const std::string path = "basal.zones[1].turbulent_coefficient_m_s2";
  const auto keys = uncertain_keys(s);
  ASSERT_EQ(keys.size(), 1u);
  EXPECT_EQ(keys[0].path, path);
  EXPECT_EQ(keys[0].units, "m s-2");
  EXPECT_EQ(keys[0].distribution, *u.distribution);
  ASSERT_TRUE(key_of_number(path));
  EXPECT_TRUE(key_of_number(path)->above_min);
  EXPECT_FALSE(key_of_number("basal.zones[1].restitution"));
  const Scenario fixed = with_value(s, path, 300);
  EXPECT_TRUE(uncertain_keys(fixed).empty());
  EXPECT_EQ(fixed.basal.zones[1].turbulent_coefficient_m_s2, Uncertain(300));
  EXPECT_THROW(with_value(s, "basal.zones[2].friction_coefficient", 0.2), SetupError);
}

TEST(Schema, WithValueRefusesWhatIsNoNumber) {
  const auto message = [](const char* path) -> std::string {
    try {
      with_value(Scenario{}, path, 1);
    } catch (const SetupError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message("basal.friction_coeficient"),
            "basal.friction_coeficient (unknown key). Did you mean basal.friction_coefficient?");
  EXPECT_EQ(message("title"), "title = 1 (the key does not hold a single number).");
}

}  // namespace
}  // namespace sturz
