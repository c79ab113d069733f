// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/measure/table.hpp"

#include "engine/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace sturz::bench {
namespace {

nlohmann::ordered_json numbers(const Summary& s) {
  return {{"median", s.median}, {"least", s.least},       {"most", s.most}, {"low95", s.low},
          {"high95", s.high},   {"coverage", s.coverage}, {"n", s.n}};
}

std::string thousands(std::size_t count) {
  if (count < 1000) return std::to_string(count);
  return fmt::format("{},{:03}", thousands(count / 1000), count % 1000);
}

}  // namespace

Cell cell(const char* text) { return {text, text}; }
Cell cell(const std::string& text) { return {text, text}; }
Cell cell(std::size_t count) { return {thousands(count), count}; }
Cell cell(int count) { return {std::to_string(count), count}; }
Cell cell(double value, int digits) { return {fmt::format("{:.{}f}", value, digits), value}; }
Cell yes_no(bool yes) { return {yes ? "yes" : "NO", yes}; }

Cell range_cell(const Summary& s, int digits) {
  return {
      fmt::format("{:.{}f} ({:.{}f}-{:.{}f})", s.median, digits, s.least, digits, s.most, digits),
      numbers(s)};
}

Cell interval_cell(const Summary& s, int digits) {
  return {
      fmt::format("{:.{}f} [{:.{}f}, {:.{}f}]", s.median, digits, s.low, digits, s.high, digits),
      numbers(s)};
}

void Table::add(std::vector<Cell> row) {
  expect(row.size() == columns_.size(), "a row has a cell for every column");
  rows_.push_back(std::move(row));
}

std::string Table::text() const {
  std::vector<std::size_t> width;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    width.push_back(columns_[c].head.size());
    for (const auto& row : rows_) width[c] = std::max(width[c], row[c].text.size());
  }
  std::string out = title_ + "\n", rule = "|";
  auto line = [&](auto&& text_of) {
    out += "|";
    for (std::size_t c = 0; c < columns_.size(); ++c)
      out += fmt::format(" {:<{}} |", text_of(c), width[c]);
    out += "\n";
  };
  line([&](std::size_t c) { return columns_[c].head; });
  for (std::size_t w : width) rule += std::string(w + 2, '-') + "|";
  out += rule + "\n";
  for (const auto& row : rows_) line([&](std::size_t c) { return row[c].text; });
  return out;
}

nlohmann::ordered_json Table::json() const {
  auto out = nlohmann::ordered_json::array();
  for (const auto& row : rows_) {
    nlohmann::ordered_json object;
    for (std::size_t c = 0; c < columns_.size(); ++c) object[columns_[c].key] = row[c].value;
    out.push_back(std::move(object));
  }
  return out;
}

}  // namespace sturz::bench
