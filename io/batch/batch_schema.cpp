// SPDX-License-Identifier: Apache-2.0
#include "io/batch/batch_schema.hpp"

#include "io/batch/batch_keys.hpp"

#include <nlohmann/json.hpp>

#include <span>

namespace sturz {
namespace {

using Json = nlohmann::ordered_json;

Json block(std::span<const BatchKey> keys, bool defaults);

Json value_of(const BatchKey& key, bool defaults) {
  switch (key.kind) {
    case BatchKind::text:
      return {{"type", "string"}, {"minLength", 1}};
    case BatchKind::integer:
      return {{"type", "integer"}, {"minimum", key.min}, {"maximum", key.max}};
    case BatchKind::number:
      return {{"type", "number"}, {"minimum", key.min}, {"maximum", key.max}};
    case BatchKind::flag:
      return {{"type", "boolean"}};
    case BatchKind::mode:
      return {{"enum", {"ensemble", "run"}}};
    case BatchKind::window:
      return {{"type", "string"},
              {"pattern", "^([01][0-9]|2[0-3]):[0-5][0-9]-([01][0-9]|2[0-3]):[0-5][0-9]$"}};
    case BatchKind::features:
      return {{"anyOf",
               {{{"const", "each"}},
                {{"type", "array"},
                 {"items", {{"type", Json::array({"string", "number"})}}},
                 {"minItems", 1}}}}};
    case BatchKind::values:
      return {{"type", "object"}};
    case BatchKind::job:
      return block(job_keys, true);
    case BatchKind::jobs:
      return {{"type", "array"},
              {"items", block(job_keys, defaults)},
              {"minItems", 1},
              {"maxItems", most_jobs}};
  }
  return {};
}

Json block(std::span<const BatchKey> keys, bool defaults) {
  Json properties = Json::object();
  for (const BatchKey& key : keys) {
    if (defaults && !is_for_defaults(key)) continue;
    Json value = value_of(key, false);
    value["description"] = key.help;
    properties[key.name] = std::move(value);
  }
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

}  // namespace

std::string batch_schema() {
  Json j = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
            {"title", "sturz batch list"}};
  const Json top = block(batch_keys, false);
  for (const auto& [name, value] : top.items()) j[name] = value;
  j["required"] = {"jobs"};
  j["properties"]["jobs"]["items"]["required"] = {"name"};
  return j.dump(2) + "\n";
}

}  // namespace sturz
