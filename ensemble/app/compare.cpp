// SPDX-License-Identifier: Apache-2.0
// sturz compare: two finished ensembles side by side.
#include "ensemble/workflow/comparison/compare.hpp"

#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace sturz::app {
namespace {

struct Options {
  std::string a, b;
  std::string out = "out/comparison";
  bool unpaired = false;
};

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const workflow::Compared& c) {
  return {{"event", "done"},
          {"maps", c.maps.string()},
          {"pairs", c.n_pairs},
          {"valid_members_a", c.n_a},
          {"valid_members_b", c.n_b},
          {"cut_off_members", c.cut_off},
          {"scene_differences", c.differences},
          {"least_difference", c.summary.least},
          {"most_difference", c.summary.most},
          {"cells_less", c.summary.n_less},
          {"cells_more", c.summary.n_more},
          {"median_gain_of_pairs", number(c.summary.median_gain)},
          {"assets", c.n_assets}};
}

int compare(const Options& options, Console& console) {
  ConsoleObserver observer(console);
  const workflow::Compared c = workflow::compare(
      {options.a, options.b, options.out, !options.unpaired}, observer, interrupt_flag());
  for (const std::string& difference : c.differences) console.say("  " + difference);
  if (c.n_pairs > 0)
    console.say(fmt::format("  {} pairs of {} and {} valid members", c.n_pairs, c.n_a, c.n_b));
  else
    console.say(fmt::format("  {} and {} valid members, no pairs", c.n_a, c.n_b));
  if (c.cut_off > 0)
    console.say(
        fmt::format("  {} of them were cut off: differences may be more or less", c.cut_off));
  console.say(
      fmt::format("  P(reached), B less A: {:+.3f} to {:+.3f}; the 95 % interval, each cell for "
                  "itself, lies below 0 in {} cells, above in {}",
                  c.summary.least, c.summary.most, c.summary.n_less, c.summary.n_more));
  if (std::isfinite(c.summary.median_gain))
    console.say(
        fmt::format("  intervals from pairs are {:.2f} times narrower than without them "
                    "(median over {} cells)",
                    c.summary.median_gain, c.summary.n_cells));
  console.say(c.has_page
                  ? "In " + options.out + ": report.html with A and B beside each other"
                  : "In " + options.out + "; no report.html, since A or B has no finished maps");
  console.event(json_text(json_of(c)));
  return ok;
}

}  // namespace

void add_compare(Grammar& grammar) {
  auto [parser, options] = add_command(
      grammar, "compare", "How much two ensembles differ, member by member: with and without a dam",
      compare);
  parser.add_option("a", options.a, "Folder of an ensemble")->type_name("DIR")->required();
  parser.add_option("b", options.b, "Folder of another one of the same site")
      ->type_name("DIR")
      ->required();
  parser.add_option("-o,--out", options.out, "Folder for the results")
      ->type_name("DIR")
      ->capture_default_str();
  parser.add_flag("--unpaired", options.unpaired,
                  "Members of the same number are no pairs: other designs, formulations, models");
  add_remote(parser);
  add_json(grammar, parser);
}

}  // namespace sturz::app
