// SPDX-License-Identifier: Apache-2.0
// Any bytes into the scenario reader: it answers with a scenario or with ScenarioError, never with
// anything else; and what it accepted it must write and read back unchanged. Bytes after a NUL are
// an override.
#include "io/scenario/scenario_file.hpp"

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> overrides;
  if (const auto cut = text.find('\0'); cut != std::string::npos) {
    overrides.push_back(text.substr(cut + 1));
    text.resize(cut);
  }
  sturz::Scenario scenario;
  try {
    scenario = sturz::read_scenario_text(text, "fuzz.yaml", "cases", overrides);
  } catch (const sturz::ScenarioError& error) {
    if (error.problems().empty()) std::abort();
    return 0;
  }
  const std::string written = sturz::write_scenario(scenario);
  if (sturz::read_scenario_text(written, "written.yaml", "cases") != scenario) std::abort();
  return 0;
}
