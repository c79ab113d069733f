// SPDX-License-Identifier: Apache-2.0
/// Values of a batch list out of YAML nodes. Included by .cpp files only.
#pragma once

#include "io/batch/batch_file.hpp"
#include "io/batch/batch_keys.hpp"
#include "io/scenario/number_nodes.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sturz {

std::optional<int> read_whole(const std::string& path, const BatchKey&, const YamlNode&,
                              FileProblems&);
std::optional<double> read_amount(const std::string& path, const BatchKey&, const YamlNode&,
                                  FileProblems&);
std::optional<bool> read_flag(const std::string& path, const YamlNode&, FileProblems&);
std::optional<DayWindow> read_window(const std::string& path, const YamlNode&, FileProblems&);
/// True: run.
std::optional<bool> read_mode(const std::string& path, const YamlNode&, FileProblems&);
/// {key: value, ...}.
std::vector<BatchValue> read_changes(const std::string& path, const YamlNode&, FileProblems&);
/// Features into the entry: `each`, or a list.
void read_features(const std::string& path, const YamlNode&, BatchEntry&, FileProblems&);

/// A node as YAML on one line that reads back to the same node.
std::string one_line_yaml(const YamlNode&);

}  // namespace sturz
