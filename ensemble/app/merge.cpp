// SPDX-License-Identifier: Apache-2.0
// sturz merge: maps from the members that shards have left in a folder.
#include "ensemble/workflow/results/merge.hpp"

#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/app/region/region.hpp"
#include "ensemble/app/verdict.hpp"
#include "ensemble/hazard/hazard_layers.hpp"
#include "ensemble/workflow/region/region_folder.hpp"
#include "ensemble/workflow/results/weighted_maps.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace sturz::app {
namespace {

struct Options {
  std::string folder;
  bool partial = false;   ///< maps from the members that are there
  std::string posterior;  ///< folder of a calibration; empty: all members count alike
};

int weighted(const Options& options, Console& console) {
  ConsoleObserver observer(console);
  const workflow::WeightedMapsMade made = workflow::make_weighted_maps(
      {options.folder, options.partial}, options.posterior, observer, interrupt_flag());
  const std::string folder = made.folder.root.string();
  console.clear_progress();
  console.say(fmt::format("{} valid members, {}. Results are in {}:", made.valid,
                          weighting_text(made.effective_members), folder));
  console.say("  report.html   look here first");
  list_maps(made.folder, console);
  for (const std::string& warning : made.warnings) console.warn(warning);
  console.event(json_text(nlohmann::json{{"event", "done"},
                                         {"weighted", true},
                                         {"valid", made.valid},
                                         {"effective_members", made.effective_members},
                                         {"hazard_hash", made.hazard_hash},
                                         {"folder", folder}}));
  return ok;
}

int merge(const Options& options, Console& console) {
  if (options.posterior.empty() && workflow::is_region(std::filesystem::path(options.folder)))
    return region_merge(options.folder, options.partial, console);
  if (!options.posterior.empty()) return weighted(options, console);
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
  parser
      .add_option(
          "--posterior", options.posterior,
          "Weigh the members by what `sturz calibrate` found in this folder; the maps go to "
          "DIR/weighted")
      ->type_name("DIR");
  add_remote(parser);
  add_json(grammar, parser);
}

}  // namespace sturz::app
