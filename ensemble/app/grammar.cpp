// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/grammar.hpp"

namespace sturz::app {

void add_scenario(CLI::App& parser, std::string& scenario, std::vector<std::string>& set) {
  parser.add_option("scenario", scenario, "Scenario file (YAML)")
      ->type_name("SCENARIO")
      ->required();
  add_set(parser, set, "key=value: replaces one value of the scenario; may be repeated");
}

void add_set(CLI::App& parser, std::vector<std::string>& set, const char* help) {
  parser.add_option("--set", set, help)
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_json(Grammar& grammar, CLI::App& parser, const char* help) {
  parser.add_flag("--json", grammar.json, help);
}

}  // namespace sturz::app
