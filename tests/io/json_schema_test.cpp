// SPDX-License-Identifier: Apache-2.0
#include "io/scenario/json_schema.hpp"

#include "io/scenario/scenario_file.hpp"
#include "scenarios/schema/schema.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace sturz {
namespace {

using Json = nlohmann::json;

/// The schema of a key or block, by its path.
Json at_path(const Json& schema, const std::string& path) {
  Json node = schema;
  std::istringstream names(path);
  for (std::string name; std::getline(names, name, '.');) node = node.at("properties").at(name);
  return node;
}

TEST(JsonSchema, IsJsonAndHoldsEveryKey) {
  const Json j = Json::parse(json_schema());
  EXPECT_EQ(j.at("$schema"), "https://json-schema.org/draft/2020-12/schema");
  for (const auto& key : schema()) {
    const Json node = at_path(j, key.path);
    EXPECT_TRUE(node.at("description").get<std::string>().starts_with(key.help)) << key.path;
  }
}

TEST(JsonSchema, CarriesLimitsChoicesAndDistributions) {
  const Json j = Json::parse(json_schema());
  const Json friction = at_path(j, "basal.friction_coefficient");
  EXPECT_EQ(friction.at("anyOf").at(0).at("maximum"), 2);
  EXPECT_EQ(friction.at("anyOf").at(1).at("$ref"), "#/$defs/distribution");
  EXPECT_EQ(at_path(j, "terrain.nodata").at("enum"), Json({"outflow", "wall"}));
  EXPECT_EQ(at_path(j, "numerics.spacing_m").at("exclusiveMinimum"), 0);
  EXPECT_EQ(at_path(j, "release.box.x_m").at("maxItems"), 2);
  EXPECT_EQ(at_path(j, "numerics").at("required"), Json::array({"spacing_m"}));
  EXPECT_EQ(j.at("$defs").at("distribution").at("properties").size(), 9u);
  EXPECT_EQ(j.at("required"), Json({"terrain", "numerics"}));
  ASSERT_EQ(j.at("anyOf").size(), 3u);
  EXPECT_EQ(j.at("anyOf").at(0).at("required"), Json::array({"grains"}));
  EXPECT_EQ(j.at("anyOf").at(1).at("required"), Json::array({"fluid"}));
  EXPECT_FALSE(j.at("additionalProperties").get<bool>());
  const Json plane = at_path(j, "terrain.synthetic").at("properties").at("plane");
  EXPECT_EQ(plane.at("required"), Json::array({"cell_size_m"}));
  EXPECT_EQ(plane.at("properties").at("slope_deg").at("default"), 30);
}

TEST(JsonSchema, KnowsTheShapeOfZones) {
  const Json j = Json::parse(json_schema());
  EXPECT_EQ(at_path(j, "formulation").at("enum"),
            Json({"auto", "full_stress", "depth_averaged", "discrete"}));
  const Json zones = at_path(j, "basal.zones");
  EXPECT_EQ(zones.at("maxItems"), 255);
  const Json zone = zones.at("items");
  EXPECT_EQ(zone.at("required"), Json::array({"polygon"}));
  EXPECT_FALSE(zone.at("additionalProperties").get<bool>());
  EXPECT_EQ(zone.at("properties").size(), 6u);
  EXPECT_EQ(zone.at("properties").at("layer").at("type"), "string");
  EXPECT_EQ(zone.at("properties").at("pore_pressure_ratio").at("anyOf").at(0).at("maximum"), 0.99);
  ASSERT_EQ(zone.at("anyOf").size(), 4u);
  EXPECT_EQ(zone.at("anyOf").at(0).at("required"), Json::array({"friction_coefficient"}));
}

TEST(JsonSchema, KnowsTheKeysOfTheShippedCases) {
  const Json j = Json::parse(json_schema());
  for (const char* name : {"zhangjiawan", "shuicheng_dry", "usgs_flume", "mud_flow", "flume",
                           "shuicheng", "column_in_water"}) {
    const std::string folder = std::string(STURZ_SOURCE_DIR "/scenarios/cases/") + name;
    const auto file = read_scenario_file(folder + "/scenario.yaml");
    const bool liquid_alone = file.positions.count("grains") == 0;  // has fewer keys to give
    EXPECT_GT(file.positions.size(), liquid_alone ? 15u : 20u) << name;
    for (const auto& [path, position] : file.positions) EXPECT_NO_THROW(at_path(j, path)) << path;
    for (const auto& required : j.at("required"))
      EXPECT_EQ(file.positions.count(required.get<std::string>()), 1u) << name;
    EXPECT_GE(file.positions.count("grains") + file.positions.count("fluid"), 1u) << name;
  }
}

}  // namespace
}  // namespace sturz
