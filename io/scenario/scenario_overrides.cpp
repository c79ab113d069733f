// SPDX-License-Identifier: Apache-2.0
#include "io/scenario/scenario_overrides.hpp"

#include "io/files/plain_text.hpp"

#include <utility>

namespace sturz {
namespace {

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> names;
  std::size_t start = 0;
  while (true) {
    const std::size_t dot = path.find('.', start);
    names.push_back(path.substr(start, dot - start));
    if (dot == std::string::npos) return names;
    start = dot + 1;
  }
}

/// Every node of an override stands where the override stands: inner columns would mislead.
void place_all(YamlNode& node, const Position& at) {
  node.at = at;
  for (auto& item : node.items) place_all(item, at);
  for (auto& entry : node.entries) {
    entry.at = at;
    place_all(entry.value, at);
  }
}

void remove_entry(YamlNode& block, const std::string& name, const Position& at,
                  const std::string& path, std::vector<FileProblem>& problems) {
  for (auto entry = block.entries.begin(); entry != block.entries.end(); ++entry)
    if (entry->key == name) {
      block.entries.erase(entry);
      return;
    }
  problems.push_back({at, path + " = null (there is nothing to remove)."});
}

/// The map that holds the last name of the path; made where it is missing. nullptr if a value is
/// in the way.
YamlNode* holder(YamlNode& root, const std::vector<std::string>& names, const Position& at) {
  YamlNode* node = &root;
  for (std::size_t i = 0;; ++i) {
    if (node->kind == YamlNode::Kind::empty) node->kind = YamlNode::Kind::map;
    if (node->kind != YamlNode::Kind::map) return nullptr;
    if (i + 1 == names.size()) return node;
    YamlEntry* next = node->find(names[i]);
    if (!next) {
      YamlNode block;
      block.kind = YamlNode::Kind::map;
      block.at = at;
      next = &node->entries.emplace_back(YamlEntry{names[i], at, std::move(block)});
    }
    node = &next->value;
  }
}

}  // namespace

void put_value(YamlNode& root, const std::string& path, const std::string& value,
               const Position& at, std::vector<FileProblem>& problems) {
  std::vector<FileProblem> own;
  auto node = parse_yaml(value, at.source, own);
  for (auto& problem : own) problems.push_back({at, std::move(problem.message)});
  if (!node) return;
  place_all(*node, at);
  const auto names = split(path);
  YamlNode* block = holder(root, names, at);
  if (!block) {
    problems.push_back({at, path + " (a part of this path holds a value, not a block)."});
    return;
  }
  if (node->kind == YamlNode::Kind::empty)
    remove_entry(*block, names.back(), at, path, problems);
  else if (YamlEntry* entry = block->find(names.back()))
    entry->value = std::move(*node);
  else
    block->entries.push_back({names.back(), at, std::move(*node)});
}

void apply_override(YamlNode& root, const std::string& text, std::vector<FileProblem>& problems) {
  const std::size_t equals = text.find('=');
  const std::string path = text.substr(0, equals);
  const Position at{"--set " + one_line(path, 80), 0, 0};
  bool named = equals != std::string::npos;
  for (const auto& name : split(path)) named = named && !name.empty();
  if (!named) {
    problems.push_back({at, "must look like key.path=value."});
    return;
  }
  const std::string value = text.substr(equals + 1);
  if (value.find_first_not_of(" \t\r\n") == std::string::npos) {
    problems.push_back({at, "has no value. Write key.path=value; null removes a key."});
    return;
  }
  put_value(root, path, value, at, problems);
}

}  // namespace sturz
