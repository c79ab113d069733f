// SPDX-License-Identifier: Apache-2.0
#include "scenarios/layers/feature_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace sturz {
namespace {

std::string cell_text(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }
std::string cell_text(std::int64_t value) { return fmt::format("{}", value); }
std::string cell_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

}  // namespace

std::string to_csv(const FeatureTable& table) {
  std::string text;
  const auto end_cell = [&](std::size_t k) { text += k + 1 < table.columns.size() ? ',' : '\n'; };
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    text += cell_text(table.columns[k].name);
    end_cell(k);
  }
  for (std::size_t row = 0; row < table.size(); ++row)
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      text += std::visit([&](const auto& values) { return cell_text(values[row]); },
                         table.columns[k].values);
      end_cell(k);
    }
  return text;
}

}  // namespace sturz
