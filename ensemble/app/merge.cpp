// SPDX-License-Identifier: Apache-2.0
// sturz merge: maps from the members that shards have left in a folder.
#include "ensemble/workflow/results/merge.hpp"

#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/app/verdict.hpp"

namespace sturz::app {
namespace {

struct Options {
  std::string folder;
  bool partial = false;  ///< maps from the members that are there
};

int merge(const Options& options, Console& console) {
  ConsoleObserver observer(console);
  return verdict(
      workflow::merge_members({options.folder, options.partial}, observer, interrupt_flag()),
      console);
}

}  // namespace

void add_merge(Grammar& grammar) {
  auto [parser, options] =
      add_command(grammar, "merge", "Make the maps from the members of a results folder", merge);
  parser.add_option("folder", options.folder, "Folder of an ensemble")
      ->type_name("DIR")
      ->required();
  parser.add_flag("--partial", options.partial, "Go on although members are missing");
  add_remote(parser);
  add_json(grammar, parser);
}

}  // namespace sturz::app
