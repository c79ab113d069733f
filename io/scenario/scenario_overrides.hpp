// SPDX-License-Identifier: Apache-2.0
/// Overrides from the command line, laid over the tree of a scenario file before it is read.
#pragma once

#include "io/scenario/yaml_tree.hpp"

#include <string>
#include <vector>

namespace sturz {

/// Puts the value of "key.path=yaml value" into the tree; `null` removes the entry.
void apply_override(YamlNode& root, const std::string& text, std::vector<FileProblem>&);

/// Puts a value at a path, making the blocks on the way.
/// \param value YAML; `null` removes the key \param at where all of it is said to stand
void put_value(YamlNode& root, const std::string& path, const std::string& value,
               const Position& at, std::vector<FileProblem>& problems);

}  // namespace sturz
