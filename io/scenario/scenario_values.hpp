// SPDX-License-Identifier: Apache-2.0
/// From the text of a YAML node to a typed value, as the key table says.
#pragma once

#include "io/scenario/yaml_tree.hpp"
#include "scenarios/schema/schema.hpp"

#include <vector>

namespace sturz {

/// The value of one key. Problems (wrong type, not a number, unknown inner name) are added and
/// make the result monostate; ranges are not checked here.
KeyValue read_value(const KeyInfo&, const YamlNode&, std::vector<FileProblem>&);

/// A number or a distribution in its place; monostate where it is neither.
KeyValue read_uncertain(const KeyInfo&, const YamlNode&, std::vector<FileProblem>&);

}  // namespace sturz
