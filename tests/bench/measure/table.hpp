// SPDX-License-Identifier: Apache-2.0
/// Tables that a reader sees as text and a program as JSON, from the same cells.
#pragma once

#include "tests/bench/measure/statistics.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace sturz::bench {

struct Cell {
  std::string text;
  nlohmann::ordered_json value;
};

Cell cell(const char* text);
Cell cell(const std::string& text);
Cell cell(std::size_t count);
Cell cell(int count);
Cell cell(double value, int digits);
/// Median and range.
Cell range_cell(const Summary&, int digits);
/// Median and its interval.
Cell interval_cell(const Summary&, int digits);
Cell yes_no(bool);

struct Column {
  std::string key;   ///< in JSON
  std::string head;  ///< in the printed table
};

class Table {
 public:
  /// \param key  name in JSON
  Table(std::string key, std::string title, std::vector<Column> columns)
      : key_(std::move(key)), title_(std::move(title)), columns_(std::move(columns)) {}

  void add(std::vector<Cell> row);
  const std::string& key() const { return key_; }
  bool empty() const { return rows_.empty(); }
  std::string text() const;
  nlohmann::ordered_json json() const;  ///< an array of objects, one per row

 private:
  std::string key_, title_;
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// A figure that is kept in a history and told in a sentence.
struct Figure {
  std::string name;
  double value = 0, low = 0, high = 0;  ///< median and its interval
  bool more_is_better = true;
  std::string sentence;  ///< what it means, for who reads no table
};

/// What one sub-command found, in the order in which it was found.
struct Report {
  std::string title, summary;  ///< of a page made from it
  std::vector<Table> tables;
  std::vector<Figure> figures;
  std::vector<std::string> notes;  ///< how the figures are to be read
  bool failed = false;             ///< a limit that was asked for does not hold

  void tell(std::string name, const Summary& s, std::string sentence, bool more_is_better = true) {
    figures.push_back(
        {std::move(name), s.median, s.low, s.high, more_is_better, std::move(sentence)});
  }
};

}  // namespace sturz::bench
