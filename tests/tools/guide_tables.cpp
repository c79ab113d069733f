// SPDX-License-Identifier: Apache-2.0
// Writes the tables of the user guide from the program's own: every block between
// `<!-- generated: ... -->` and `<!-- end -->`. With --check it only compares.
#include "ensemble/censoring/scalar_censoring.hpp"
#include "ensemble/hazard/hazard_layers.hpp"
#include "scenarios/schema/schema.hpp"
#include "scenarios/schema/value_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace sturz {
namespace {

/// Every optional block present, so that each key shows its default.
Scenario with_all_blocks() {
  Scenario s;
  for (const BlockInfo& block : optional_blocks()) block.make(s);
  return s;
}

std::string unit_text(const std::string& units) {
  return units.empty() || units == "1" ? "" : " [" + units + "]";
}

/// Coordinates are limited too, but by what no map reaches: that need not be read.
bool is_limit(double bound, const KeyInfo& key) {
  return std::isfinite(bound) && !(key.units == "m" && std::abs(bound) >= 1e8);
}

std::string range_of(const KeyInfo& key) {
  if (!key.choices.empty()) return fmt::format("{}", fmt::join(key.choices, " / "));
  if (key.kind == ValueKind::flag) return "true / false";
  const bool low = is_limit(key.min, key), high = is_limit(key.max, key);
  if (low && high)
    return fmt::format("{}{:g} to {:g}", key.above_min ? "> " : "", key.min, key.max);
  if (low) return fmt::format("{} {:g}", key.above_min ? ">" : "≥", key.min);
  return high ? fmt::format("≤ {:g}", key.max) : "";
}

/// A source shape has to be given whole; the zeros that its struct starts with are no defaults.
std::string default_of(const KeyInfo& key, const Scenario& defaults) {
  for (const char* shape : {"release.box.", "release.paraboloid.", "release.cylinder."})
    if (key.path.starts_with(shape)) return "";
  return key.required ? "**required**" : value_text(key.get(defaults));
}

std::string key_row(const KeyInfo& key, const Scenario& defaults) {
  return fmt::format("| `{}`{} | {} | {} | {}{} |\n", key.path,
                     key.kind == ValueKind::uncertain ? " ±" : "", range_of(key),
                     default_of(key, defaults), key.help, unit_text(key.units));
}

/// Keys of one top-level block; "scene" stands for those that lie in none.
std::string key_table(const std::string& block) {
  const Scenario defaults = with_all_blocks();
  std::string table = "| key | range | default | meaning |\n|---|---|---|---|\n";
  for (const KeyInfo& key : schema()) {
    const auto dot = key.path.find('.');
    if ((dot == std::string::npos ? "scene" : key.path.substr(0, dot)) == block)
      table += key_row(key, defaults);
  }
  return table;
}

std::string layer_row(const Layer& layer, bool has_bounds) {
  const std::string axis =
      layer.axis.values.empty() ? "" : "`" + layer.axis.name + "`" + unit_text(layer.axis.units);
  return fmt::format("| `{}`{} | {} | {}{}{} |\n", layer.name,
                     has_bounds ? ", `…_lower`, `…_upper`" : "", axis, layer.long_name,
                     unit_text(layer.units), layer.comment.empty() ? "" : ": " + layer.comment);
}

/// The bounds of a probability share its row.
std::string layer_table() {
  Grid cell;
  cell.n_cols = cell.n_rows = 1;
  const auto layers = hazard_layers(cell, HazardSpec{}, 0, 0, 0, {true, true, true}).stack.layers;
  std::string table = "| layer | one plane per | meaning |\n|---|---|---|\n";
  for (std::size_t i = 0; i < layers.size(); ++i)
    if (!layers[i].meaning.is_bound())
      table += layer_row(layers[i], i + 1 < layers.size() && layers[i + 1].meaning.is_bound());
  return table;
}

std::string known_text(Known known) {
  switch (known) {
    case Known::exactly:
      return "known";
    case Known::at_least:
      return "at least";
    case Known::not_at_all:
      break;
  }
  return "not known";
}

/// Scalars that say the same of a member that is cut off share a row.
std::string censoring_table() {
  std::map<std::pair<Known, Known>, std::string> names;
  for (const ScalarInfo& scalar : scalar_table()) {
    std::string& list = names[{known(scalar.field, Censoring::left_terrain),
                               known(scalar.field, Censoring::still_moving)}];
    list += fmt::format("{}`{}`", list.empty() ? "" : ", ", scalar.name);
  }
  std::string table = "| scalar | mass left the terrain | mass still moves |\n|---|---|---|\n";
  for (const auto& [how, list] : names)
    table += fmt::format("| {} | {} | {} |\n", list, known_text(how.first), known_text(how.second));
  return table;
}

std::string generated(const std::string& what) {
  if (what == "censoring") return censoring_table();
  if (what.starts_with("keys ")) return key_table(what.substr(5));
  if (what == "layers") return layer_table();
  throw std::runtime_error("nothing is known to generate for '" + what + "'");
}

/// Every key has its row: a new top-level block needs a heading and an empty generated block.
void require_all_blocks(const std::string& guide) {
  for (const std::string& name : names_in_block(""))
    if (is_block(name) && guide.find("<!-- generated: keys " + name + " -->") == std::string::npos)
      throw std::runtime_error("there is no generated block for the keys of `" + name + "`");
}

std::string with_tables(const std::string& guide) {
  require_all_blocks(guide);
  constexpr std::string_view opening = "<!-- generated: ", closing = " -->\n",
                             end = "<!-- end -->\n";
  std::string text;
  std::size_t at = 0;
  for (std::size_t open; (open = guide.find(opening, at)) != std::string::npos;) {
    const std::size_t name = open + opening.size(), body = guide.find(closing, name);
    const std::size_t stop = guide.find(end, body);
    if (body == std::string::npos || stop == std::string::npos)
      throw std::runtime_error("a generated block is not closed");
    text += guide.substr(at, body + closing.size() - at);
    text += generated(guide.substr(name, body - name));
    at = stop;
  }
  return text + guide.substr(at);
}

int run(const std::string& file, bool check) {
  std::ostringstream content;
  content << std::ifstream(file).rdbuf();
  const std::string before = content.str(), after = with_tables(before);
  if (before == after) return 0;
  if (!check) {
    std::ofstream(file) << after;
    return 0;
  }
  std::fprintf(stderr, "%s: tables differ from the program's. Write them with guide_tables.\n",
               file.c_str());
  return 1;
}

}  // namespace
}  // namespace sturz

int main(int argc, char** argv) {
  const bool check = argc == 3 && std::string(argv[1]) == "--check";
  if (argc != 2 && !check) {
    std::fprintf(stderr, "usage: guide_tables [--check] FILE\n");
    return 2;
  }
  try {
    return sturz::run(argv[argc - 1], check);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    return 2;
  }
}
