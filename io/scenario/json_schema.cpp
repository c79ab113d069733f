// SPDX-License-Identifier: Apache-2.0
#include "io/scenario/json_schema.hpp"

#include "io/scenario/distribution_nodes.hpp"
#include "scenarios/schema/dam_fields.hpp"
#include "scenarios/schema/inflow_fields.hpp"
#include "scenarios/schema/schema.hpp"
#include "scenarios/schema/zone_fields.hpp"
#include "scenarios/shapes/synthetic_terrain.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace sturz {
namespace {

using Json = nlohmann::ordered_json;

Json number(double min, double max, bool above_min) {
  Json j = {{"type", "number"}};
  if (std::isfinite(min)) j[above_min ? "exclusiveMinimum" : "minimum"] = min;
  if (std::isfinite(max)) j["maximum"] = max;
  return j;
}

Json numbers(const Json& item, int size) {
  Json j = {{"type", "array"}, {"items", item}};
  if (size > 0) {
    j["minItems"] = size;
    j["maxItems"] = size;
  }
  return j;
}

Json object(const Json& properties, const Json& required) {
  Json j = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) j["required"] = required;
  return j;
}

/// One of the names in `properties`, and only one.
Json one_of(const Json& properties) {
  Json j = object(properties, Json::array());
  j["minProperties"] = 1;
  j["maxProperties"] = 1;
  return j;
}

Json distribution_parameters(const DistributionForm& form) {
  const Json any = {{"type", "number"}};
  const bool lists = form.kind == Distribution::Kind::discrete;
  Json properties = Json::object(), required = Json::array();
  for (const char* name : form.required) {
    properties[name] = lists ? numbers(any, 0) : any;
    required.push_back(name);
  }
  for (const char* name : form.optional) properties[name] = lists ? numbers(any, 0) : any;
  if (form.kind == Distribution::Kind::table) return numbers(any, 0);
  Json named = object(properties, required);
  if (form.list.empty()) return named;
  return {{"anyOf", {numbers(any, static_cast<int>(form.list.size())), named}}};
}

Json distribution() {
  Json properties = Json::object();
  for (const auto& form : distribution_forms())
    properties[form.name] = distribution_parameters(form);
  Json j = one_of(properties);
  j["description"] = "A distribution in the place of a number.";
  return j;
}

Json synthetic() {
  Json shapes = Json::object();
  for (const auto& shape : synthetic_shapes()) {
    Json properties = {{"cell_size_m", number(min_synthetic_cell_m, max_synthetic_cell_m, false)}};
    for (const auto& p : shape_parameters(shape)) {
      properties[p.name] = number(p.min, p.max, false);
      properties[p.name]["default"] = p.default_value;
      properties[p.name]["description"] = p.help;
    }
    shapes[shape] = object(properties, {"cell_size_m"});
  }
  return one_of(shapes);
}

Json walls() {
  const Json triple = numbers({{"type", "number"}}, 3);
  const Json wall = object({{"point_m", triple},
                            {"normal", triple},
                            {"friction_coefficient", number(0, 2, false)},
                            {"remove_at_s", number(0, 1e5, false)},
                            {"liquid", {{"enum", {"slips", "sticks"}}}}},
                           {"point_m", "normal"});
  return {{"type", "array"}, {"items", wall}};
}

Json words() { return {{"type", "string"}, {"minLength", 1}}; }

/// A number or a distribution in its place.
Json uncertain(const Json& plain) {
  return {{"anyOf", {plain, {{"$ref", "#/$defs/distribution"}}}}};
}

/// A file and at least one of the numbers.
Json zones() {
  Json properties = {{"polygon", words()}, {"layer", words()}};
  Json any_number = Json::array();
  for (const auto& field : zone_fields) {
    const KeyInfo& key = basal_key(field);
    properties[field.name] = uncertain(number(key.min, key.max, key.above_min));
    any_number.push_back({{"required", {field.name}}});
  }
  Json zone = object(properties, {"polygon"});
  zone["anyOf"] = any_number;
  return {{"type", "array"}, {"items", zone}, {"maxItems", most_basal_zones}};
}

/// A line and a height.
Json dams() {
  Json properties = Json::object();
  for (const auto& text : dam_texts) properties[text.name] = words();
  properties["points_m"] = {
      {"type", "array"}, {"items", numbers({{"type", "number"}}, 2)}, {"minItems", 2}};
  for (const auto& field : dam_fields)
    properties[field.name] = uncertain(number(field.min, field.max, field.above_min));
  for (const auto& fixed : dam_numbers)
    properties[fixed.name] = number(fixed.min, fixed.max, false);
  Json dam = object(properties, Json::array());
  dam["oneOf"] = {{{"required", {"height_m"}}},
                  {{"required", {"height_attribute"}}},
                  {{"required", {"crest_elevation_m"}}}};
  return {{"type", "array"}, {"items", dam}, {"maxItems", most_dams}};
}

/// Maps of numbers and points by name.
Json records(const KeyInfo& key) {
  Json properties = Json::object(), required = Json::array();
  for (const RecordField& field : key.fields) {
    const Json one = number(field.min, field.max, false);
    properties[field.name] = field.size == 1 ? one : numbers(one, static_cast<int>(field.size));
    if (field.required) required.push_back(field.name);
  }
  return {{"type", "array"}, {"items", object(properties, required)}};
}

Json corners(int least) {
  return {{"type", "array"}, {"items", numbers({{"type", "number"}}, 2)}, {"minItems", least}};
}

/// A hydrograph and one place.
Json inflows() {
  Json properties = {{"name", words()}, {"hydrograph", words()}, {"line_m", corners(2)},
                     {"line", words()}, {"polygon", words()},    {"layer", words()},
                     {"crs", words()}};
  for (const auto& field : inflow_fields)
    properties[field.name] = uncertain(number(field.min, field.max, field.above_min));
  Json source = object(properties, {"hydrograph"});
  source["oneOf"] = {
      {{"required", {"line_m"}}}, {{"required", {"line"}}}, {{"required", {"polygon"}}}};
  return {{"type", "array"}, {"items", source}, {"maxItems", most_inflows}};
}

Json gauges(const char* place, const Json& corner) {
  return {{"type", "array"},
          {"items", object({{"name", words()}, {place, corner}}, {"name", place})}};
}

Json value_of(const KeyInfo& key) {
  Json plain = number(key.min, key.max, key.above_min);
  switch (key.kind) {
    case ValueKind::number:
      return plain;
    case ValueKind::integer: {
      Json j = plain;
      j["type"] = "integer";
      return j;
    }
    case ValueKind::text:
    case ValueKind::path:
      return words();
    case ValueKind::choice:
      return {{"enum", key.choices}};
    case ValueKind::flag:
      return {{"type", "boolean"}};
    case ValueKind::uncertain:
      return uncertain(plain);
    case ValueKind::number_list:
      return numbers(plain, key.list_size);
    case ValueKind::text_list:
      return {{"type", "array"}, {"items", {{"enum", key.choices}}}, {"uniqueItems", true}};
    case ValueKind::number_map:
      return {{"type", "object"}, {"additionalProperties", plain}};
    case ValueKind::path_map:
      return {{"type", "object"}, {"additionalProperties", words()}};
    case ValueKind::synthetic:
      return synthetic();
    case ValueKind::wall_list:
      return walls();
    case ValueKind::dam_list:
      return dams();
    case ValueKind::zone_list:
      return zones();
    case ValueKind::record_list:
      return records(key);
    case ValueKind::inflow_list:
      return inflows();
    case ValueKind::gauge_points:
      return gauges("at_m", numbers({{"type", "number"}}, 2));
    case ValueKind::gauge_lines:
      return gauges("points_m", corners(2));
  }
  return {};
}

Json described(Json j, const std::string& help, const std::string& units) {
  const bool shown = !units.empty() && units != "1";
  j["description"] = help + (shown ? " [" + units + "]" : "");
  return j;
}

/// The keys and blocks right below `block` ("" = top level).
Json block_of(const std::string& block) {
  Json properties = Json::object(), required = Json::array();
  for (const auto& name : names_in_block(block)) {
    const std::string path = block.empty() ? name : block + "." + name;
    const KeyInfo* key = find_key(path);
    properties[name] = key ? described(value_of(*key), key->help, key->units) : block_of(path);
    if (key && key->required) required.push_back(name);
  }
  Json j = object(properties, required);
  for (const auto& optional : optional_blocks())
    if (optional.path == block) j["description"] = optional.help;
  return j;
}

}  // namespace

std::string json_schema() {
  Json j = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
            {"title", "sturz scenario"}};
  const Json top = block_of("");
  for (const auto& [name, value] : top.items()) j[name] = value;
  j["required"] = {"terrain", "numerics"};
  j["anyOf"] = Json::array();  // something that moves
  for (const char* block : {"grains", "fluid", "material"})
    j["anyOf"].push_back({{"required", Json::array({block})}});
  j["properties"]["terrain"]["oneOf"] = {{{"required", {"raster"}}}, {{"required", {"synthetic"}}}};
  j["$defs"] = {{"distribution", distribution()}};
  return j.dump(2) + "\n";
}

}  // namespace sturz
