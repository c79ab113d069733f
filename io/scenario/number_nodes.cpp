// SPDX-License-Identifier: Apache-2.0
#include "io/scenario/number_nodes.hpp"

#include "scenarios/schema/number_text.hpp"

#include <algorithm>

namespace sturz {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

/// What may have been meant by a scalar that is no number.
std::string number_hint(const YamlNode& node) {
  const std::string& text = node.text;
  if (node.quoted) return parse_number(text) ? "Remove the quotes." : "";
  const std::string word = lower(text);
  for (const char* special : {"nan", ".nan", "inf", "-inf", ".inf", "-.inf", "+.inf", "infinity"})
    if (word == special) return "It must be finite.";
  if (word.starts_with("0x") || word.starts_with("0o")) return "Write it in decimal.";
  std::string pointed = text;
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  if (pointed != text && parse_number(pointed)) return "Use a decimal point: " + pointed + ".";
  if (text.starts_with('+') && parse_number(text.substr(1))) return "Leave out the plus sign.";
  if (text.ends_with('%')) return "Write a fraction between 0 and 1.";
  const auto end = text.find_first_not_of("0123456789.eE+-");
  if (end != 0 && end != std::string::npos && parse_number(text.substr(0, end)))
    return "Write the number alone: its unit is part of the key's name.";
  return "";
}

}  // namespace

void add_mismatch(const std::string& path, const YamlNode& node, const std::string& expected,
                  const std::string& hint, FileProblems& problems) {
  if (node.kind == YamlNode::Kind::empty) {
    problems.push_back({node.at, path + " (has no value; must be " + expected +
                                     "). Give it one or remove the key."});
    return;
  }
  problems.push_back({node.at, path + " = " + node.shown() + " (must be " + expected + ")." +
                                   (hint.empty() ? "" : " " + hint)});
}

std::optional<double> read_number(const std::string& path, const YamlNode& node,
                                  const std::string& expected, FileProblems& problems) {
  const bool scalar = node.kind == YamlNode::Kind::scalar;
  if (scalar && !node.quoted)
    if (const auto value = parse_number(node.text)) return value;
  add_mismatch(path, node, expected, scalar ? number_hint(node) : "", problems);
  return std::nullopt;
}

std::optional<long long> read_integer(const std::string& path, const YamlNode& node,
                                      FileProblems& problems) {
  const bool scalar = node.kind == YamlNode::Kind::scalar;
  if (scalar && !node.quoted)
    if (const auto value = parse_integer(node.text)) return value;
  add_mismatch(path, node, "a whole number", scalar ? number_hint(node) : "", problems);
  return std::nullopt;
}

std::optional<std::vector<double>> read_numbers(const std::string& path, const YamlNode& node,
                                                FileProblems& problems) {
  if (node.kind != YamlNode::Kind::list) {
    add_mismatch(path, node, "a list of numbers, [a, b, ...]", "", problems);
    return std::nullopt;
  }
  std::vector<double> numbers;
  bool good = true;
  for (const auto& item : node.items) {
    const auto number = read_number(path, item, "a list of numbers", problems);
    good = good && number;
    if (number) numbers.push_back(*number);
  }
  if (!good) return std::nullopt;
  return numbers;
}

}  // namespace sturz
