// SPDX-License-Identifier: Apache-2.0
/// The design table as text; the file it lies in is the caller's.
#include "engine/core/error.hpp"
#include "ensemble/sampling/design.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace sturz {
namespace {

constexpr std::string_view cube_prefix = "unit_cube:";
constexpr std::string_view title = "# design table: one row per member, drawn once";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Cells of a line; quotes around a whole cell are dropped (spreadsheets like to add them).
std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const auto end = std::min(line.find(separator, start), line.size());
    std::string_view cell = trimmed(line.substr(start, end - start));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
      cell = cell.substr(1, cell.size() - 2);
    cells.emplace_back(cell);
    start = end + 1;
  }
  return cells;
}

template <class T>
bool parse(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

/// What a column holds.
struct Column {
  enum class Role { member, value, unit_cube } role = Role::value;
  std::string key;
};

class Reader {
 public:
  DesignTable read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark
    table_.design = Design::table;
    while (!text.empty()) {
      const auto end = std::min(text.find('\n'), text.size());
      ++line_number_;
      read_line(trimmed(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    require(!columns_.empty(),
            "design table: no line of keys (the first line names the columns). Add it.");
    require(table_.values.size() > 0,
            "design table: no rows below the line of keys (each row is a member). Add rows.");
    if (table_.units.empty()) table_.units.resize(table_.keys.size());
    require(table_.units.size() == table_.keys.size(),
            "design table: the line of units has not one unit per key (the file was changed by "
            "hand?). Restore it.");
    return std::move(table_);
  }

 private:
  void fail(const std::string& message) const {
    throw SetupError(fmt::format("design table, line {}: {}", line_number_, message));
  }

  void read_line(std::string_view line) {
    if (line.empty()) return;
    if (line.front() == '#')
      read_comment(line);
    else if (columns_.empty())
      read_header(line);
    else
      read_row(line);
  }

  void read_comment(std::string_view line) {
    const auto colon = line.find(':');
    if (colon == std::string_view::npos) return;
    const std::string_view name = trimmed(line.substr(1, colon - 1));
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (name == "design") {
      const auto design = from_word<Design>(value);
      if (!design)
        fail(fmt::format("design '{}' is not known (it says how the rows were drawn). Restore it.",
                         value));
      table_.design = *design;
    }
    if (name == "seed" && !parse(value, table_.seed))
      fail(fmt::format("seed '{}' is not a whole number (it names the random stream). Restore it.",
                       value));
    if (name == "posterior") table_.is_posterior = true;
    if (name == "units" && !value.empty()) table_.units = cells_of(value, ',');
  }

  void read_header(std::string_view line) {
    if (line.find(',') == std::string_view::npos && line.find(';') != std::string_view::npos)
      fail(
          "columns are separated by ';' (commas are needed, and points in numbers). Save the "
          "table as comma-separated values.");
    for (const std::string& cell : cells_of(line, ',')) {
      if (cell == "member" && columns_.empty()) {
        columns_.push_back({Column::Role::member, cell});
      } else if (cell.starts_with(cube_prefix)) {
        columns_.push_back({Column::Role::unit_cube, cell.substr(cube_prefix.size())});
        cube_keys_.push_back(columns_.back().key);
      } else {
        if (cell.empty()) fail("a column has no name (each is a scenario key). Name it.");
        columns_.push_back({Column::Role::value, cell});
        table_.keys.push_back(cell);
      }
    }
    if (!cube_keys_.empty() && cube_keys_ != table_.keys)
      fail(
          "the unit_cube columns are not those of the keys (the file was changed by hand?). "
          "Restore them.");
  }

  double number(const std::string& cell, const Column& column) const {
    double value = 0;
    if (!parse(cell, value) || !std::isfinite(value))
      fail(fmt::format("'{}' in column {} is not a finite number (points, no units). Correct it.",
                       cell, column.key));
    return value;
  }

  void read_row(std::string_view line) {
    const std::vector<std::string> cells = cells_of(line, ',');
    if (cells.size() != columns_.size())
      fail(fmt::format("{} cells for {} columns (each column needs one). Correct the row.",
                       cells.size(), columns_.size()));
    std::vector<double> values, cube;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (columns_[c].role == Column::Role::member)
        check_member(cells[c]);
      else
        (columns_[c].role == Column::Role::value ? values : cube)
            .push_back(number(cells[c], columns_[c]));
    }
    table_.values.push_back(std::move(values));
    const bool drawn_without_keys = table_.keys.empty() && table_.design != Design::table;
    if (!cube_keys_.empty() || drawn_without_keys) table_.unit_cube.push_back(std::move(cube));
  }

  void check_member(const std::string& cell) const {
    std::int64_t member = -1;
    if (!parse(cell, member) || member != table_.n_members())
      fail(fmt::format("member '{}' where {} is due (rows count 0, 1, 2, ...). Restore the order.",
                       cell, table_.n_members()));
  }

  DesignTable table_;
  std::vector<Column> columns_;
  std::vector<std::string> cube_keys_;
  std::size_t line_number_ = 0;
};

}  // namespace

std::string to_csv(const DesignTable& table) {
  std::string text = fmt::format("{}\n# design: {}\n# seed: {}\n# units: {}\nmember", title,
                                 to_string(table.design), table.seed, fmt::join(table.units, ","));
  if (table.is_posterior)
    text.insert(text.find("\nmember"), "\n# posterior: keys without a column keep their prior");
  for (const std::string& key : table.keys) text += "," + key;
  if (!table.unit_cube.empty())
    for (const std::string& key : table.keys) text += fmt::format(",{}{}", cube_prefix, key);
  text += '\n';
  for (std::size_t i = 0; i < table.values.size(); ++i) {
    text += std::to_string(i);
    for (const double value : table.values[i]) text += fmt::format(",{:.17g}", value);
    if (!table.unit_cube.empty())
      for (const double u : table.unit_cube[i]) text += fmt::format(",{:.17g}", u);
    text += '\n';
  }
  return text;
}

DesignTable from_csv(std::string_view text) { return Reader().read(text); }

}  // namespace sturz
