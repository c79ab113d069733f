// SPDX-License-Identifier: Apache-2.0
#include "io/scenario/dam_nodes.hpp"

#include "io/scenario/node_texts.hpp"
#include "io/scenario/scenario_values.hpp"
#include "scenarios/schema/dam_fields.hpp"

#include <algorithm>

namespace sturz {
namespace {

void read_corners(const std::string& path, const YamlNode& node,
                  std::vector<std::array<double, 2>>& corners, FileProblems& problems) {
  const char* const expected = "a list of corners, [[x, y], [x, y], ..]";
  if (node.kind != YamlNode::Kind::list) {
    add_mismatch(path, node, expected, "", problems);
    return;
  }
  for (const YamlNode& item : node.items) {
    const auto numbers = read_numbers(path, item, problems);
    if (!numbers) continue;
    if (numbers->size() == 2)
      corners.push_back({(*numbers)[0], (*numbers)[1]});
    else
      add_mismatch(path, item, expected, "", problems);
  }
}

/// \return false: no such name
bool read_entry(const std::string& inner, const std::string& name, const YamlNode& value,
                DamSpec& dam, FileProblems& problems) {
  for (const DamText& text : dam_texts)
    if (name == text.name) {
      dam.*text.value =
          read_text(inner, text.is_path ? file_name : "text", value, problems).value_or("");
      return true;
    }
  for (const DamField& field : dam_fields)
    if (name == field.name) {
      KeyInfo key;
      key.path = inner;
      const KeyValue number = read_uncertain(key, value, problems);
      if (const auto* read = std::get_if<Uncertain>(&number)) dam.*field.value = *read;
      return true;
    }
  for (const DamNumber& number : dam_numbers)
    if (name == number.name) {
      if (const auto read = read_number(inner, value, "a number", problems))
        dam.*number.value = *read;
      return true;
    }
  if (name != "points_m") return false;
  read_corners(inner, value, dam.points_m, problems);
  return true;
}

}  // namespace

bool read_dam(const std::string& path, const YamlNode& node, DamSpec& dam, FileProblems& problems) {
  if (node.kind != YamlNode::Kind::map) {
    add_mismatch(path, node, "a dam, {line: dam.gpkg, height_m: 8}", "", problems);
    return false;
  }
  const std::size_t before = problems.size();
  for (const auto& [name, at, value] : node.entries)
    if (!read_entry(path + "." + name, name, value, dam, problems))
      problems.push_back({at, unknown_text(path, name, dam_names())});
  return problems.size() == before;
}

}  // namespace sturz
