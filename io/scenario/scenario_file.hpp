// SPDX-License-Identifier: Apache-2.0
/// Scenario files: YAML in and out, strict, with every problem named at its place.
#pragma once

#include "engine/core/error.hpp"
#include "io/scenario/yaml_tree.hpp"
#include "scenarios/scenario.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sturz {

/// Everything that is wrong with a scenario file. what() has one problem a line:
/// `file:line:column: key.path = value (must be ...). Hint`.
class ScenarioError : public SetupError {
 public:
  explicit ScenarioError(std::vector<std::string> problems);
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

/// A scenario and where each of its keys was written.
struct ScenarioFile {
  Scenario scenario;
  std::map<std::string, Position> positions;  ///< key or block path -> its value's place
};

/// Reads and validates a scenario file; values may stay distributions.
/// \param overrides "key.path=yaml value", in the place of what the file says; the value `null`
///        removes a key or block. Later ones win.
/// \throws ScenarioError with all problems at once, IoError when the file cannot be read
Scenario read_scenario(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {});
ScenarioFile read_scenario_file(const std::filesystem::path& file,
                                const std::vector<std::string>& overrides = {});

/// The same for text in memory.
/// \param name what problems call the source; \param directory where relative paths start
Scenario read_scenario_text(std::string_view text, const std::string& name,
                            const std::filesystem::path& directory = {},
                            const std::vector<std::string>& overrides = {});
ScenarioFile read_scenario_file_text(std::string_view text, const std::string& name,
                                     const std::filesystem::path& directory = {},
                                     const std::vector<std::string>& overrides = {});

/// YAML with every key and its default written out, in the key table's order, that reads back to
/// an equal scenario.
/// \param for_directory where the text will be stored: relative input paths are rewritten to lead
///        from there to the same files. Empty keeps them as they are.
std::string write_scenario(const Scenario&, const std::filesystem::path& for_directory = {});

}  // namespace sturz
