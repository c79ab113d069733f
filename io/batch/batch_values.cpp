// SPDX-License-Identifier: Apache-2.0
#include "io/batch/batch_values.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sturz {
namespace {

/// Says what the number must be, unless it is in the key's range.
template <class Number>
std::optional<Number> in_range(const std::string& path, const BatchKey& key, const YamlNode& node,
                               std::optional<Number> number, FileProblems& problems) {
  if (!number ||
      (*number >= static_cast<Number>(key.min) && *number <= static_cast<Number>(key.max)))
    return number;
  problems.push_back({node.at, fmt::format("{} = {} (must be in {:.10g}..{:.10g}).", path,
                                           node.text, key.min, key.max)});
  return std::nullopt;
}

/// A word that YAML reads as the same word inside brackets.
bool is_plain(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ||
           c == '_' || c == '-' || c == '+' || c == '/';
  });
}

std::string in_quotes(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (c == '\n')
      quoted += "\\n";
    else if (c == '\t')
      quoted += "\\t";
    else
      quoted += c;
  }
  return quoted + '"';
}

}  // namespace

std::string one_line_yaml(const YamlNode& node) {
  std::string line;
  switch (node.kind) {
    case YamlNode::Kind::empty:
      return "null";
    case YamlNode::Kind::scalar:
      return !node.quoted && is_plain(node.text) ? node.text : in_quotes(node.text);
    case YamlNode::Kind::list:
      for (const YamlNode& item : node.items)
        line += (line.empty() ? "" : ", ") + one_line_yaml(item);
      return "[" + line + "]";
    case YamlNode::Kind::map:
      for (const YamlEntry& entry : node.entries)
        line += (line.empty() ? "" : ", ") +
                (is_plain(entry.key) ? entry.key : in_quotes(entry.key)) + ": " +
                one_line_yaml(entry.value);
      return "{" + line + "}";
  }
  return line;
}

std::optional<int> read_whole(const std::string& path, const BatchKey& key, const YamlNode& node,
                              FileProblems& problems) {
  const auto number = in_range(path, key, node, read_integer(path, node, problems), problems);
  return number ? std::optional(static_cast<int>(*number)) : std::nullopt;
}

std::optional<double> read_amount(const std::string& path, const BatchKey& key,
                                  const YamlNode& node, FileProblems& problems) {
  return in_range(path, key, node, read_number(path, node, "a number", problems), problems);
}

std::optional<bool> read_flag(const std::string& path, const YamlNode& node,
                              FileProblems& problems) {
  const bool word = node.kind == YamlNode::Kind::scalar && !node.quoted;
  if (word && node.text == "true") return true;
  if (word && node.text == "false") return false;
  add_mismatch(path, node, "true or false", "", problems);
  return std::nullopt;
}

std::optional<DayWindow> read_window(const std::string& path, const YamlNode& node,
                                     FileProblems& problems) {
  if (node.kind == YamlNode::Kind::scalar)
    if (const auto window = parse_day_window(node.text)) return window;
  add_mismatch(path, node, "two times of day, \"20:00-06:00\"", "", problems);
  return std::nullopt;
}

std::optional<bool> read_mode(const std::string& path, const YamlNode& node,
                              FileProblems& problems) {
  if (node.kind == YamlNode::Kind::scalar && node.text == "ensemble") return false;
  if (node.kind == YamlNode::Kind::scalar && node.text == "run") return true;
  add_mismatch(path, node, "ensemble or run", "", problems);
  return std::nullopt;
}

std::vector<BatchValue> read_changes(const std::string& path, const YamlNode& node,
                                     FileProblems& problems) {
  std::vector<BatchValue> changes;
  if (node.kind != YamlNode::Kind::map) {
    add_mismatch(path, node, "{key of the scenario: value}", "", problems);
    return changes;
  }
  for (const YamlEntry& entry : node.entries) {
    const auto end = entry.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_.[]");
    const bool dots = entry.key.starts_with('.') || entry.key.ends_with('.') ||
                      entry.key.find("..") != std::string::npos;
    if (entry.key.empty() || end != std::string::npos || dots) {
      problems.push_back({entry.at, fmt::format("{}.{} (must be a key of a scenario, such as "
                                                "basal.friction_coefficient).",
                                                path, entry.key)});
      continue;
    }
    changes.push_back({entry.key, one_line_yaml(entry.value), entry.value.at});
  }
  return changes;
}

void read_features(const std::string& path, const YamlNode& node, BatchEntry& entry,
                   FileProblems& problems) {
  entry.features_at = node.at;
  if (node.kind == YamlNode::Kind::scalar && node.text == "each") {
    entry.each_feature = true;
    return;
  }
  const bool list = node.kind == YamlNode::Kind::list && !node.items.empty() &&
                    std::all_of(node.items.begin(), node.items.end(), [](const YamlNode& item) {
                      return item.kind == YamlNode::Kind::scalar && !item.text.empty();
                    });
  if (!list)
    return add_mismatch(path, node, "each, or a list of features' names or numbers", "", problems);
  for (const YamlNode& item : node.items) entry.features.push_back(one_line_yaml(item));
}

}  // namespace sturz
