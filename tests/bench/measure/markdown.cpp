// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/measure/markdown.hpp"

#include <fmt/core.h>

namespace sturz::bench {
namespace {

std::string text_of(const nlohmann::ordered_json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

std::string markdown_page(const Report& report, const nlohmann::ordered_json& machine,
                          const std::string& command) {
  std::string out = report.title.empty() ? "# Measured\n" : "# " + report.title + "\n";
  out += fmt::format("{}Made by `{}`; do not edit.\n\n",
                     report.summary.empty() ? "" : report.summary + "\n\n", command);
  std::string facts;
  for (const auto& [key, value] : machine.items())
    facts += fmt::format("{}{} {}", facts.empty() ? "" : ", ", key, text_of(value));
  out += "Machine: " + facts + ".\n";
  for (const Table& table : report.tables) {
    const std::string text = table.text();
    const auto end_of_title = text.find('\n');
    out += "\n## " + text.substr(0, end_of_title) + "\n";
    out += table.empty() ? "None.\n" : text.substr(end_of_title + 1);
  }
  if (!report.notes.empty()) out += "\n## How to read it\n";
  for (const std::string& note : report.notes) out += "- " + note + "\n";
  return out;
}

}  // namespace sturz::bench
