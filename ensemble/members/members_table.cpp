// SPDX-License-Identifier: Apache-2.0
#include "ensemble/members/members_table.hpp"

#include "engine/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sturz {
namespace {

std::string quoted(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

std::string number(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

/// Cells of one line, to be joined by commas.
using Cells = std::vector<std::string>;

std::string line_of(const Cells& cells) { return fmt::format("{}\n", fmt::join(cells, ",")); }

std::string header(const DesignTable& design) {
  Cells cells{"member", "outcome", "censored", "reason", "formulation"};
  for (const std::string& key : design.keys) cells.push_back(quoted(key));
  for (const ScalarInfo& scalar : scalar_table()) cells.emplace_back(scalar.name);
  cells.insert(cells.end(), {"binding_limit", "warnings", "state_hash"});
  return line_of(cells);
}

std::string row(const DesignTable& design, const MemberSummary& m) {
  require(m.member >= 0 && m.member < design.n_members(),
          fmt::format("member {} is not in the design table of {} members (results of another "
                      "ensemble?). Use the directory that the design was written to.",
                      m.member, design.n_members()));
  Cells cells{std::to_string(m.member), std::string(to_string(m.outcome)),
              std::string(to_string(m.censoring)), quoted(m.reason), quoted(m.formulation)};
  for (const double value : design.values[static_cast<std::size_t>(m.member)])
    cells.push_back(number(value));
  const bool has_result = m.outcome != Outcome::failed && m.outcome != Outcome::cancelled;
  for (const ScalarInfo& scalar : scalar_table())
    cells.push_back(has_result ? number(m.scalars.*scalar.field) : std::string());
  cells.push_back(quoted(m.binding_limit));
  cells.push_back(quoted(m.warnings));
  cells.push_back(has_result ? fmt::format("{:016x}", m.state_hash) : std::string());
  return line_of(cells);
}

}  // namespace

std::string members_csv(const DesignTable& design, std::span<const MemberSummary> members) {
  std::vector<const MemberSummary*> ordered;
  for (const MemberSummary& m : members) ordered.push_back(&m);
  std::sort(ordered.begin(), ordered.end(),
            [](const auto* a, const auto* b) { return a->member < b->member; });
  std::string text = header(design);
  for (const MemberSummary* m : ordered) text += row(design, *m);
  return text;
}

}  // namespace sturz
