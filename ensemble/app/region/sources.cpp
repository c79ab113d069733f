// SPDX-License-Identifier: Apache-2.0
// sturz sources: which sources of a region hit a place.
#include "engine/core/error.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/workflow/region/region_query.hpp"
#include "scenarios/schema/number_text.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz::app {
namespace {

struct Options {
  std::string folder;
  std::string at;  ///< "X,Y"
};

std::pair<double, double> place_of(const std::string& text) {
  const std::size_t comma = std::min(text.find(','), text.size());
  const auto x = parse_number(text.substr(0, comma));
  const auto y = parse_number(text.substr(std::min(comma + 1, text.size())));
  require(
      x && y && std::isfinite(*x) && std::isfinite(*y),
      fmt::format("--at {} (must be X,Y in metres of the maps, such as 397120,4628500).", text));
  return {*x, *y};
}

nlohmann::ordered_json json_of(const workflow::SourcesAt& found) {
  nlohmann::ordered_json sources = nlohmann::ordered_json::array(),
                         values = nlohmann::ordered_json::object();
  for (const auto& [name, p] : found.sources)
    sources.push_back({{"source", name}, {"probability", p}});
  for (const auto& [name, value] : found.values) {
    if (std::isfinite(value))
      values[name] = value;
    else
      values[name] = nullptr;
  }
  return {{"event", "sources"},  {"x_m", found.x_m},   {"y_m", found.y_m}, {"row", found.row},
          {"column", found.col}, {"sources", sources}, {"values", values}};
}

int sources(const Options& options, Console& console) {
  const auto [x, y] = place_of(options.at);
  const workflow::SourcesAt found = workflow::sources_at(options.folder, x, y);
  console.event(json_text(json_of(found)));
  console.say(fmt::format("cell at x {:.10g}, y {:.10g} (row {}, column {} of the maps)", found.x_m,
                          found.y_m, found.row, found.col));
  if (found.sources.empty()) console.say("no source reaches it");
  for (const auto& [name, p] : found.sources) console.say(fmt::format("  {:>7.4f}  {}", p, name));
  for (const auto& [name, value] : found.values)
    if (std::isfinite(value)) console.say(fmt::format("  {} {:.6g}", name, value));
  return ok;
}

}  // namespace

void add_sources(Grammar& grammar) {
  auto [parser, options] = add_command(
      grammar, "sources", "Which sources of a region hit a place, and how probably", sources);
  parser.add_option("folder", options.folder, "Folder of a region")->type_name("DIR")->required();
  parser.add_option("--at", options.at, "The place, in coordinates of the maps")
      ->type_name("X,Y")
      ->required();
  add_json(grammar, parser);
}

}  // namespace sturz::app
