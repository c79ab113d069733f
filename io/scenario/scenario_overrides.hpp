// SPDX-License-Identifier: Apache-2.0
/// Overrides from the command line, laid over the tree of a scenario file before it is read.
#pragma once

#include "io/scenario/yaml_tree.hpp"

#include <string>
#include <vector>

namespace sturz {

/// Puts the value of "key.path=yaml value" into the tree; `null` removes the entry.
void apply_override(YamlNode& root, const std::string& text, std::vector<FileProblem>&);

}  // namespace sturz
