// SPDX-License-Identifier: Apache-2.0
#include "tests/physics/results/known_misses.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace sturz::test {
namespace {

constexpr std::size_t n_columns = 7;

/// Cells of one line; commas within quotes are text.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

double number_of(const std::string& cell, int line) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (end == cell.c_str() || *end != 0 || !std::isfinite(value))
    throw std::runtime_error(fmt::format("known misses, line {}: {} (no number)", line, cell));
  return value;
}

}  // namespace

std::vector<KnownMiss> read_misses(const std::string& text) {
  std::vector<KnownMiss> misses;
  std::istringstream in(text);
  int n = 0;
  for (std::string line; std::getline(in, line);) {
    if (++n == 1 || line.empty()) continue;
    const auto cells = cells_of(line);
    if (cells.size() != n_columns || cells[0].empty() || cells[5].empty() || cells[6].empty())
      throw std::runtime_error(fmt::format("known misses, line {}: cells missing", n));
    const auto same = [&](const KnownMiss& m) { return m.name == cells[0]; };
    if (std::any_of(misses.begin(), misses.end(), same))
      throw std::runtime_error(fmt::format("known misses, line {}: {} twice", n, cells[0]));
    misses.push_back({cells[0], cells[1], number_of(cells[2], n), number_of(cells[3], n),
                      number_of(cells[4], n), cells[5], cells[6]});
  }
  return misses;
}

const std::vector<KnownMiss>& known_misses() {
  static const std::vector<KnownMiss> list = [] {
    const std::string path = STURZ_SOURCE_DIR "/tests/physics/results/known_misses.csv";
    std::ifstream in(path);
    if (!in) throw std::runtime_error(path + " (cannot be read)");
    std::stringstream text;
    text << in.rdbuf();
    return read_misses(text.str());
  }();
  return list;
}

bool listed(const std::vector<KnownMiss>& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(), [&](const KnownMiss& m) { return m.name == name; });
}

std::string objection(const std::vector<KnownMiss>& list, const std::string& name, double error,
                      double tolerance) {
  const bool within = std::abs(error) <= tolerance;
  const auto listed =
      std::find_if(list.begin(), list.end(), [&](const KnownMiss& m) { return m.name == name; });
  if (listed == list.end())
    return within ? ""
                  : fmt::format(
                        "{}: error {:.4g} of {:.4g}, and tests/physics/results/known_misses.csv "
                        "does not list it",
                        name, error, tolerance);
  if (within)
    return fmt::format("{}: no longer missed ({:.4g} of {:.4g}): take it off the list", name, error,
                       tolerance);
  const bool as_listed = (error < 0) == (listed->error < 0);  // a loss is no excuse for a gain
  if (as_listed && std::abs(error) < worse_by * std::abs(listed->error)) return "";
  return fmt::format("{}: a known miss of {:.4g} has become {:.4g}", name, listed->error, error);
}

}  // namespace sturz::test
