// SPDX-License-Identifier: Apache-2.0
/// Words out of YAML nodes, and what is said of unknown names.
#pragma once

#include "io/scenario/number_nodes.hpp"
#include "scenarios/schema/suggest.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sturz {

/// A name that a map of a list does not know.
inline std::string unknown_text(const std::string& path, const std::string& key,
                                const std::vector<std::string>& known) {
  const std::string near = nearest_name(key, known);
  return path + "." + key + " (unknown key). " +
         (near.empty() ? "Known here: " + comma_separated(known) + "."
                       : "Did you mean " + near + "?");
}

inline constexpr const char* file_name = "a file name";

/// \param expected "text" or file_name
inline std::optional<std::string> read_text(const std::string& path, const char* expected,
                                            const YamlNode& node, FileProblems& problems) {
  if (node.kind == YamlNode::Kind::scalar && !node.text.empty()) return node.text;
  if (node.kind == YamlNode::Kind::scalar)
    problems.push_back(
        {node.at, path + " = \"\" (must be " + expected + "). Give it one or remove the key."});
  else
    add_mismatch(path, node, expected, "", problems);
  return std::nullopt;
}

}  // namespace sturz
