// SPDX-License-Identifier: Apache-2.0
#include "io/site/flow/hydrograph_csv.hpp"

#include "engine/core/error.hpp"
#include "io/files/plain_text.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace sturz {
namespace {

constexpr double latest_s = 1e7, most_discharge = 1e7;
/// Smaller sums are rounding, or a unit that is wrong.
constexpr double least_volume = 1e-6;
constexpr double least_solids = 0.05, most_solids = 0.85;
constexpr std::size_t most_rows = 1000000, most_problems = 50;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const auto end = std::min(line.find(',', start), line.size());
    std::string_view cell = trimmed(line.substr(start, end - start));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
      cell = trimmed(cell.substr(1, cell.size() - 2));
    cells.push_back(cell);
    start = end + 1;
  }
  return cells;
}

enum class Role { time, discharge, solids };

struct Column {
  const char* name;
  Role role;
  double factor;  ///< to SI
};
constexpr std::array<Column, 6> known_columns{{{"time_s", Role::time, 1},
                                               {"time_min", Role::time, 60},
                                               {"time_h", Role::time, 3600},
                                               {"discharge_m3_s", Role::discharge, 1},
                                               {"discharge_l_s", Role::discharge, 1e-3},
                                               {"solid_fraction", Role::solids, 1}}};

class Reader {
 public:
  explicit Reader(const std::string& name) : name_(name) {}

  Hydrograph read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark
    if (const auto byte = first_unreadable(text))
      throw SetupError(fmt::format("{}:{}: holds {} (no plain text). Save it as CSV in UTF-8.",
                                   name_, byte->line, byte->what));
    while (!text.empty() && problems_.size() < most_problems && !hopeless_) {
      const auto end = std::min(text.find('\n'), text.size());
      ++line_;
      if (const auto line = trimmed(text.substr(0, end)); !line.empty() && line.front() != '#')
        columns_.empty() ? read_header(line) : read_row(line);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (!hopeless_) check_whole();
    require(problems_.empty(), fmt::format("{}", fmt::join(problems_, "\n")));
    return std::move(out_);
  }

 private:
  void add(const std::string& message) {
    problems_.push_back(fmt::format("{}:{}: {}", name_, line_, message));
  }

  void read_header(std::string_view line) {
    if (line.find(',') == std::string_view::npos && line.find(';') != std::string_view::npos) {
      add("columns are separated by ';' (commas are needed, and points in numbers). Save the table "
          "as comma-separated values.");
      hopeless_ = true;
      return;
    }
    for (const std::string_view cell : cells_of(line)) read_name(cell);
    for (const auto& [role, names] :
         {std::pair{Role::time, "time_s"}, std::pair{Role::discharge, "discharge_m3_s"}})
      if (!has(role)) {
        add(
            fmt::format("no column {} (the first line names the columns with their units: time_s, "
                        "discharge_m3_s, solid_fraction). Add it.",
                        names));
        hopeless_ = true;
      }
  }

  void read_name(std::string_view cell) {
    std::vector<std::string> names;
    for (const Column& known : known_columns) {
      names.emplace_back(known.name);
      if (cell != known.name) continue;
      if (has(known.role))
        add(fmt::format("{} (there is another column of the same kind). Keep one.", cell));
      columns_.push_back(known);
      return;
    }
    const std::string shown = one_line(cell, 60), near = nearest_name(shown, names);
    add(fmt::format(
        "column '{}' is not known{}. {}", shown,
        near.empty() ? " (it is none of " + comma_separated(names) + ")" : "",
        near.empty() ? "Name it with its unit, or leave it out." : "Did you mean " + near + "?"));
    hopeless_ = true;
  }

  bool has(Role role) const {
    for (const Column& c : columns_)
      if (c.role == role) return true;
    return false;
  }

  std::optional<double> number(std::string_view cell, const Column& column) {
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error == std::errc{} && end == cell.data() + cell.size() && std::isfinite(value))
      return value * column.factor;
    add(fmt::format("'{}' in column {} is not a finite number (points, no units). Correct it.",
                    one_line(cell, 40), column.name));
    return std::nullopt;
  }

  void read_row(std::string_view line) {
    const auto cells = cells_of(line);
    if (cells.size() != columns_.size())
      return add(fmt::format("{} cells for {} columns (each column needs one). Correct the row.",
                             cells.size(), columns_.size()));
    if (out_.time_s.size() >= most_rows) {
      add(fmt::format("more than {} rows (no flow needs so many). Thin them out.", most_rows));
      hopeless_ = true;
      return;
    }
    const std::size_t before = problems_.size();
    double time = 0, discharge = 0, solids = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto value = number(cells[c], columns_[c]);
      if (!value) continue;
      if (columns_[c].role == Role::time) time = *value;
      if (columns_[c].role == Role::discharge) discharge = *value;
      if (columns_[c].role == Role::solids) solids = *value;
    }
    if (problems_.size() != before) return;
    check_row(time, discharge, solids);
    out_.time_s.push_back(time);
    out_.discharge_m3_s.push_back(discharge);
    if (has(Role::solids)) out_.solid_fraction.push_back(solids);
  }

  void check_row(double time, double discharge, double solids) {
    if (time < 0 || time > latest_s)
      add(fmt::format("time = {:g} s (must be in 0..{:g}; inflow.start_time_s shifts all of them).",
                      time, latest_s));
    if (!out_.time_s.empty() && !(time > out_.time_s.back()))
      add(fmt::format(
          "time = {:g} s is not after that of the row before, {:g} s (times rise). Sort "
          "the rows.",
          time, out_.time_s.back()));
    if (discharge < 0 || discharge > most_discharge)
      add(fmt::format("discharge = {:g} m3/s (must be in 0..{:g}). Is its unit right?", discharge,
                      most_discharge));
    if (has(Role::solids) && (solids < least_solids || solids > most_solids))
      add(
          fmt::format("solid_fraction = {:g} (must be in {:g}..{:g}, the share of grains in the "
                      "volume).",
                      solids, least_solids, most_solids));
  }

  void check_whole() {
    if (columns_.empty())
      return add("is empty (the first line names the columns: time_s, discharge_m3_s). Fill it.");
    if (out_.time_s.size() < 2) {
      if (problems_.empty())
        add("fewer than two rows (a flow has a beginning and an end). Add rows.");
      return;
    }
    if (problems_.empty() && !(out_.total_m3() >= least_volume))
      add("brings no volume (less than a cubic centimetre in all). Correct the discharges.");
  }

  const std::string& name_;
  Hydrograph out_;
  std::vector<Column> columns_;
  std::vector<std::string> problems_;
  int line_ = 0;
  bool hopeless_ = false;  ///< rows cannot be read
};

}  // namespace

Hydrograph parse_hydrograph(std::string_view text, const std::string& name) {
  return Reader(name).read(text);
}

}  // namespace sturz
