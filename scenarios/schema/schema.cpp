// SPDX-License-Identifier: Apache-2.0
#include "scenarios/schema/schema.hpp"

#include "engine/core/error.hpp"
#include "scenarios/schema/dam_fields.hpp"
#include "scenarios/schema/inflow_fields.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/schema/rows/rows.hpp"
#include "scenarios/schema/suggest.hpp"
#include "scenarios/schema/zone_fields.hpp"

#include <algorithm>
#include <unordered_map>

namespace sturz {
namespace {

std::vector<KeyInfo> all_keys() {
  std::vector<KeyInfo> keys;
  schema_rows::add_site_keys(keys);
  schema_rows::add_inflow_keys(keys);
  schema_rows::add_material_keys(keys);
  schema_rows::add_erosion_keys(keys);
  schema_rows::add_run_keys(keys);
  schema_rows::add_gauge_keys(keys);
  schema_rows::add_observation_keys(keys);
  schema_rows::add_asset_keys(keys);
  schema_rows::add_report_keys(keys);
  return keys;
}

std::vector<BlockInfo> all_optional_blocks() {
  std::vector<BlockInfo> blocks;
  schema_rows::add_site_blocks(blocks);
  schema_rows::add_material_blocks(blocks);
  schema_rows::add_discrete_blocks(blocks);
  schema_rows::add_fluid_blocks(blocks);
  schema_rows::add_structure_blocks(blocks);
  schema_rows::add_bed_field_blocks(blocks);
  schema_rows::add_erosion_blocks(blocks);
  schema_rows::add_run_blocks(blocks);
  schema_rows::add_gauge_blocks(blocks);
  schema_rows::add_observation_blocks(blocks);
  schema_rows::add_asset_blocks(blocks);
  return blocks;
}

/// The name that follows "block." in `path`, or empty when `path` does not lie below the block.
std::string name_below(const std::string& path, const std::string& block) {
  std::size_t start = 0;
  if (!block.empty()) {
    if (path.size() <= block.size() + 1 || path.compare(0, block.size(), block) != 0 ||
        path[block.size()] != '.')
      return {};
    start = block.size() + 1;
  }
  return path.substr(start, path.find('.', start) - start);
}

}  // namespace

// Function-local constants: built once on first use, never changed.
std::span<const KeyInfo> schema() {
  static const std::vector<KeyInfo> keys = all_keys();
  return keys;
}

const KeyInfo* find_key(const std::string& path) {
  static const auto index = [] {
    std::unordered_map<std::string, const KeyInfo*> by_path;
    for (const auto& key : schema()) by_path.emplace(key.path, &key);
    return by_path;
  }();
  const auto found = index.find(path);
  return found == index.end() ? nullptr : found->second;
}

std::span<const BlockInfo> optional_blocks() {
  static const std::vector<BlockInfo> blocks = all_optional_blocks();
  return blocks;
}

bool is_block(const std::string& path) {
  return std::any_of(schema().begin(), schema().end(),
                     [&](const KeyInfo& key) { return !name_below(key.path, path).empty(); });
}

std::vector<std::string> names_in_block(const std::string& block) {
  std::vector<std::string> names;
  for (const auto& key : schema()) {
    const std::string name = name_below(key.path, block);
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  return names;
}

std::span<const LaterKey> later_keys() {
  static const std::vector<LaterKey> keys = {
      {"prior", "ready-made distributions by material"},
  };
  return keys;
}

void for_each_path(const KeyInfo& key, KeyValue& value,
                   const std::function<void(std::string&)>& visit) {
  if (auto* text = std::get_if<std::string>(&value); text && key.kind == ValueKind::path)
    visit(*text);
  if (auto* files = std::get_if<std::map<std::string, std::string>>(&value))
    for (auto& [name, file] : *files) visit(file);
  if (auto* dams = std::get_if<std::vector<DamSpec>>(&value))
    for (auto& dam : *dams)
      if (!dam.line.empty()) visit(dam.line);
  if (auto* zones = std::get_if<std::vector<BasalZone>>(&value))
    for (auto& zone : *zones) visit(zone.polygon);
  if (auto* sources = std::get_if<std::vector<InflowSpec>>(&value))
    for (auto& source : *sources)
      for (std::string* file : {&source.hydrograph, &source.line, &source.polygon})
        if (!file->empty()) visit(*file);
}

std::string range_text(const KeyInfo& key) {
  const bool low = key.min > -schema_rows::no_limit, high = key.max < schema_rows::no_limit;
  const std::string min = number_text(key.min), max = number_text(key.max);
  if (low && high && key.above_min) return "> " + min + " and <= " + max;
  if (low && high) return "in " + min + ".." + max;
  if (low) return (key.above_min ? "> " : ">= ") + min;
  if (high) return "<= " + max;
  return {};
}

namespace {

void add_uncertain_zones(const std::vector<BasalZone>& zones, std::vector<UncertainKey>& found) {
  for (std::size_t i = 0; i < zones.size(); ++i)
    for (const ZoneField& field : zone_fields) {
      const auto& number = zones[i].*field.value;
      if (number && number->distribution)
        found.push_back({zone_path(i, field), basal_key(field).units, *number->distribution});
    }
}

void add_uncertain_dams(const std::vector<DamSpec>& dams, std::vector<UncertainKey>& found) {
  for (std::size_t i = 0; i < dams.size(); ++i)
    for (const DamField& field : dam_fields) {
      const auto& number = dams[i].*field.value;
      if (number && number->distribution)
        found.push_back({dam_path(i, field), "m", *number->distribution});
    }
}

/// Number and field of "terrain.dams[2].height_m"; nothing for other paths.
std::optional<std::pair<std::size_t, const DamField*>> dam_of(const std::string& path) {
  if (!path.starts_with("terrain.dams[")) return std::nullopt;
  for (std::size_t i = 0; i < most_dams; ++i)
    for (const DamField& field : dam_fields)
      if (path == dam_path(i, field)) return std::pair(i, &field);
  return std::nullopt;
}

void add_uncertain_inflows(const std::vector<InflowSpec>& sources,
                           std::vector<UncertainKey>& found) {
  for (std::size_t i = 0; i < sources.size(); ++i)
    for (const InflowField& field : inflow_fields) {
      const auto& number = sources[i].*field.value;
      if (number && number->distribution)
        found.push_back({inflow_path(i, field), field.units, *number->distribution});
    }
}

/// Number and field of "inflow[2].discharge_factor"; nothing for other paths.
std::optional<std::pair<std::size_t, const InflowField*>> inflow_of(const std::string& path) {
  if (!path.starts_with("inflow[")) return std::nullopt;
  for (std::size_t i = 0; i < most_inflows; ++i)
    for (const InflowField& field : inflow_fields)
      if (path == inflow_path(i, field)) return std::pair(i, &field);
  return std::nullopt;
}

/// Number and field of "basal.zones[2].friction_coefficient"; nothing for other paths.
std::optional<std::pair<std::size_t, const ZoneField*>> zone_of(const std::string& path) {
  if (!path.starts_with("basal.zones[")) return std::nullopt;
  for (std::size_t i = 0; i < most_basal_zones; ++i)
    for (const ZoneField& field : zone_fields)
      if (path == zone_path(i, field)) return std::pair(i, &field);
  return std::nullopt;
}

}  // namespace

std::vector<UncertainKey> uncertain_keys(const Scenario& scenario) {
  std::vector<UncertainKey> found;
  for (const auto& key : schema()) {
    if (key.kind == ValueKind::dam_list) add_uncertain_dams(scenario.terrain.dams, found);
    if (key.kind == ValueKind::zone_list) add_uncertain_zones(scenario.basal.zones, found);
    if (key.kind == ValueKind::inflow_list) add_uncertain_inflows(scenario.inflow, found);
    if (key.kind != ValueKind::uncertain) continue;
    const KeyValue value = key.get(scenario);
    const auto* number = std::get_if<Uncertain>(&value);
    if (number && number->distribution)
      found.push_back({key.path, key.units, *number->distribution});
  }
  return found;
}

std::optional<KeyInfo> key_of_number(const std::string& path) {
  if (const KeyInfo* key = find_key(path)) return *key;
  if (const auto dam = dam_of(path)) return dam_key(dam->first, *dam->second);
  if (const auto source = inflow_of(path)) return inflow_key(source->first, *source->second);
  const auto zone = zone_of(path);
  return zone ? std::optional(zone_key(zone->first, *zone->second)) : std::nullopt;
}

Scenario with_value(Scenario scenario, const std::string& path, double value) {
  if (const auto zone = zone_of(path); zone && zone->first < scenario.basal.zones.size()) {
    scenario.basal.zones[zone->first].*zone->second->value = Uncertain(value);
    return scenario;
  }
  if (const auto dam = dam_of(path); dam && dam->first < scenario.terrain.dams.size()) {
    scenario.terrain.dams[dam->first].*dam->second->value = Uncertain(value);
    return scenario;
  }
  if (const auto source = inflow_of(path); source && source->first < scenario.inflow.size()) {
    scenario.inflow[source->first].*source->second->value = Uncertain(value);
    return scenario;
  }
  const KeyInfo* key = find_key(path);
  if (!key) {
    std::vector<std::string> paths;
    for (const auto& k : schema()) paths.push_back(k.path);
    const std::string near = nearest_name(path, paths);
    throw SetupError(path + " (unknown key)." +
                     (near.empty() ? "" : " Did you mean " + near + "?"));
  }
  require(key->kind == ValueKind::uncertain || key->kind == ValueKind::number,
          path + " = " + number_text(value) + " (the key does not hold a single number).");
  if (key->kind == ValueKind::uncertain)
    key->set(scenario, Uncertain(value));
  else
    key->set(scenario, value);
  return scenario;
}

}  // namespace sturz
