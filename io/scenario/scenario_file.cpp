// SPDX-License-Identifier: Apache-2.0
#include "io/scenario/scenario_file.hpp"

#include "io/files/text_files.hpp"
#include "io/scenario/binary_text.hpp"

#include <array>
#include <fstream>
#include <system_error>

namespace sturz {
namespace {

namespace fs = std::filesystem;

std::string read_checked(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);  // an error here is read_text's to explain
  if (!error && size > max_yaml_bytes) {
    std::array<char, 1024> first{};
    std::ifstream(file, std::ios::binary).read(first.data(), first.size());
    if (looks_binary({first.data(), first.size()}))
      throw ScenarioError({file.string() + ": " + binary_words});
    throw ScenarioError({file.string() + ": is " + std::to_string(size) +
                         " bytes long (a scenario file may have 65536). Move large tables into "
                         "files of their own."});
  }
  return read_text(file);
}

}  // namespace

ScenarioFile read_scenario_file(const fs::path& file, const std::vector<std::string>& overrides) {
  return read_scenario_file_text(read_checked(file), file.string(), file.parent_path(), overrides);
}

Scenario read_scenario(const fs::path& file, const std::vector<std::string>& overrides) {
  return read_scenario_file(file, overrides).scenario;
}

}  // namespace sturz
