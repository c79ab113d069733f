// SPDX-License-Identifier: Apache-2.0
#include "io/scenario/scenario_material.hpp"

#include "engine/core/error.hpp"
#include "io/scenario/scenario_overrides.hpp"
#include "scenarios/materials/materials.hpp"

#include <algorithm>

namespace sturz {
namespace {

/// The file says something there, be it nonsense that is reported later.
bool has_own(const YamlNode& root, const std::string& path) {
  const YamlNode* node = &root;
  for (std::size_t begin = 0; begin <= path.size();) {
    if (node->kind != YamlNode::Kind::map) return true;
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const YamlEntry* entry = node->find(path.substr(begin, end - begin));
    if (!entry) return false;
    node = &entry->value;
    begin = end + 1;
  }
  return true;
}

}  // namespace

void add_material_values(YamlNode& root) {
  const YamlEntry* named = root.find("material");
  if (!named || named->value.kind != YamlNode::Kind::scalar) return;
  const Material* material = find_material(named->value.text);
  if (!material) return;
  const Position at{std::string("material ") + material->name, 0, 0};
  std::vector<FileProblem> none;
  for (const MaterialValue& value : material->values)
    if (!has_own(root, value.key)) put_value(root, value.key, value.value, at, none);
  expect(none.empty(), "the values of the materials are sound");
}

}  // namespace sturz
