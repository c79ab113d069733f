// SPDX-License-Identifier: Apache-2.0
/// What the file of a sub-command needs to add itself to the command line.
#pragma once

#include "ensemble/app/console/console.hpp"

#include <CLI/CLI.hpp>

#include <any>
#include <functional>
#include <list>
#include <string>
#include <vector>

namespace sturz::app {

/// The parser, and what it found.
struct Grammar {
  CLI::App program{"sturz: from an elevation raster to a landslide hazard map", "sturz"};
  bool json = false;
  std::function<int(Console&)> action;  ///< of the chosen sub-command; returns an ExitCode
  std::list<std::any> options;          ///< of every sub-command: the parser fills them in place
};

template <class Options>
struct SubCommand {
  CLI::App& parser;
  Options& options;
};

/// Adds a sub-command that calls `run` with its options. `run` throws SetupError for what the user
/// can mend.
template <class Options>
SubCommand<Options> add_command(Grammar& grammar, const char* name, const char* help,
                                int (*run)(const Options&, Console&)) {
  auto& options = std::any_cast<Options&>(grammar.options.emplace_back(Options{}));
  CLI::App* parser = grammar.program.add_subcommand(name, help);
  parser->callback([&grammar, &options, run] {
    grammar.action = [&options, run](Console& console) { return run(options, console); };
  });
  return {*parser, options};
}

// Options that several sub-commands have.
void add_scenario(CLI::App& parser, std::string& scenario, std::vector<std::string>& set);
void add_set(CLI::App& parser, std::vector<std::string>& set, const char* help);
/// --allow-remote-inputs; takes effect while the command line is read.
void add_remote(CLI::App& parser);
/// --out, --members and --workers of the commands that compute an ensemble.
struct MembersOptions {
  std::string out;  ///< folder; empty: out/<name of the scenario>
  int members = 0;  ///< 0: as the scenario says
  int workers = 0;  ///< 0: all cores available to the process
};
/// \return --members, for what excludes it
CLI::Option* add_members(CLI::App& parser, MembersOptions&);
void add_json(Grammar&, CLI::App& parser, const char* help = "JSON lines instead of words");

}  // namespace sturz::app
