// SPDX-License-Identifier: Apache-2.0
/// Strict numbers out of YAML nodes, with a word on what the user probably meant.
#pragma once

#include "io/scenario/yaml_tree.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sturz {

using FileProblems = std::vector<FileProblem>;

/// Adds "path = shown (must be expected). Hint".
void add_mismatch(const std::string& path, const YamlNode&, const std::string& expected,
                  const std::string& hint, FileProblems&);

/// A finite decimal number; `expected` names what the key takes: "a number".
std::optional<double> read_number(const std::string& path, const YamlNode&,
                                  const std::string& expected, FileProblems&);
std::optional<long long> read_integer(const std::string& path, const YamlNode&, FileProblems&);
/// [a, b, ...]
std::optional<std::vector<double>> read_numbers(const std::string& path, const YamlNode&,
                                                FileProblems&);

}  // namespace sturz
