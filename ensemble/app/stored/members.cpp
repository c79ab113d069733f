// SPDX-License-Identifier: Apache-2.0
// sturz members: which members a folder holds, and in which files; one of them as a file of its
// own; one quantity of all of them as one file.
#include "engine/core/error.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/workflow/members/member_stack.hpp"
#include "ensemble/workflow/members/stored_members.hpp"
#include "scenarios/schema/number_text.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace sturz::app {
namespace {

struct Options {
  std::string folder;
  std::string extract;                 ///< "17" or "3,17,20-25"; empty: list
  std::string out;                     ///< folder of the extracted files; empty: DIR/extracted
  std::string stack;                   ///< file of all members on one grid; empty: none
  std::string quantity = "thickness";  ///< of the stack
  double frequency = 1;                ///< of the release [1/year]
};

workflow::MemberRange range_of(const std::string& text) {
  const std::size_t dash = text.find('-');
  const auto first = parse_integer(text.substr(0, dash));
  const auto last = dash == std::string::npos ? first : parse_integer(text.substr(dash + 1));
  require(first && last && *first >= 0 && *last >= *first,
          fmt::format("--extract {} (must be numbers of members and ranges, such as 17 or "
                      "3,17,20-25).",
                      text));
  return {*first, *last};
}

std::vector<workflow::MemberRange> ranges_of(std::string text) {
  std::vector<workflow::MemberRange> ranges;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    ranges.push_back(range_of(text.substr(0, comma)));
    text.erase(0, comma + 1);
  }
  return ranges;
}

int stack(const Options& options, Console& console) {
  require(options.extract.empty(), "--stack with --extract. Name one of them.");
  ConsoleObserver observer(console);
  const auto made =
      workflow::stack_members({options.folder, options.stack, options.quantity, options.frequency},
                              observer, interrupt_flag());
  const Grid& grid = made.written.grid;
  console.say(fmt::format("{}: {} [{}] of {} members, {} x {} cells of {} m", options.stack,
                          options.quantity, made.units, made.written.members, grid.n_rows,
                          grid.n_cols, grid.cell_m));
  if (!made.written.has_place)
    console.warn(
        "the maps lie nowhere on the earth, so the file has no latitude and longitude; "
        "CLIMADA cannot read it.");
  console.event(json_text(nlohmann::ordered_json{{"event", "done"},
                                                 {"file", options.stack},
                                                 {"quantity", options.quantity},
                                                 {"units", made.units},
                                                 {"members", made.written.members},
                                                 {"rows", grid.n_rows},
                                                 {"columns", grid.n_cols}}));
  return ok;
}

int members(const Options& options, Console& console) {
  if (!options.stack.empty()) return stack(options, console);
  ConsoleObserver observer(console);
  if (!options.extract.empty()) {
    const auto files = workflow::extract_members(
        {options.folder, ranges_of(options.extract), options.out}, observer, interrupt_flag());
    for (const auto& file : files) {
      console.say(file.string());
      console.event(json_text(nlohmann::ordered_json{{"event", "file"}, {"path", file.string()}}));
    }
    return ok;
  }
  require(options.out.empty(), "-o (without --extract). Say which members: --extract 17 -o DIR");
  const auto found = workflow::stored_members(options.folder, observer, interrupt_flag());
  console.say(fmt::format("{} members, {} of them not valid, in {} files of their own and {} packs",
                          found.n_members, found.n_failed, found.n_files, found.packs.size()));
  for (const auto& [file, n] : found.packs)
    console.say(fmt::format("  {}  {} members", file.string(), n));
  console.event(json_text(nlohmann::ordered_json{{"event", "done"},
                                                 {"members", found.n_members},
                                                 {"failed", found.n_failed},
                                                 {"files", found.n_files},
                                                 {"packs", found.packs.size()},
                                                 {"damaged", found.n_damaged}}));
  return ok;
}

}  // namespace

void add_members(Grammar& grammar) {
  auto [parser, options] =
      add_command(grammar, "members", "List the stored members, or write them as netCDF", members);
  parser.add_option("folder", options.folder, "Folder of an ensemble")
      ->type_name("DIR")
      ->required();
  parser
      .add_option("--extract", options.extract,
                  "Members to write as netCDF files, such as 17 or 3,17,20-25")
      ->type_name("NUMBERS");
  parser.add_option("-o,--out", options.out, "Folder of these files (default: DIR/extracted)")
      ->type_name("DIR");
  CLI::Option* const stacked =
      parser
          .add_option(
              "--stack", options.stack,
              "Write one quantity of all valid members as one netCDF file, which xarray and "
              "CLIMADA's Hazard read")
          ->type_name("FILE");
  parser
      .add_option(
          "--quantity", options.quantity,
          "Of the stack: thickness (default), speed, energy, pressure, arrival, deposit, ...")
      ->type_name("WORD")
      ->needs(stacked);
  parser
      .add_option("--frequency", options.frequency,
                  "Of the stack: how often the release happens (default: 1 per year); each member "
                  "has its share of it")
      ->type_name("PER_YEAR")
      ->check(CLI::PositiveNumber)
      ->needs(stacked);
  add_json(grammar, parser);
}

}  // namespace sturz::app
