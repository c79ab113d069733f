// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/grammar.hpp"

#include "io/gdal/input_trust.hpp"

namespace sturz::app {

void add_scenario(CLI::App& parser, std::string& scenario, std::vector<std::string>& set) {
  parser.add_option("scenario", scenario, "Scenario file (YAML)")
      ->type_name("SCENARIO")
      ->required();
  add_remote(parser);
  add_set(parser, set, "key=value: replaces one value of the scenario; may be repeated");
}

void add_set(CLI::App& parser, std::vector<std::string>& set, const char* help) {
  parser.add_option("--set", set, help)
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_remote(CLI::App& parser) {
  parser.add_flag_callback(
      "--allow-remote-inputs", [] { allow_remote_inputs(); },
      "Let inputs lie on the network (/vsicurl/, servers) or be raw virtual rasters");
}

CLI::Option* add_members(CLI::App& parser, MembersOptions& options) {
  parser.add_option("-o,--out", options.out, "Folder of the results (default: out/NAME)")
      ->type_name("DIR");
  CLI::Option* const members = parser.add_option("-n,--members", options.members,
                                                 "Number of members, instead of the scenario's");
  members->check(CLI::Range(1, 100000000));
  parser.add_option("--workers", options.workers, "Members at a time (default: all cores)")
      ->check(CLI::Range(1, 4096));
  return members;
}

void add_json(Grammar& grammar, CLI::App& parser, const char* help) {
  parser.add_flag("--json", grammar.json, help);
}

}  // namespace sturz::app
