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

/// Columns of results: all, but those that only some scenes have where these members have none.
std::vector<ScalarInfo> scalars_of(std::span<const MemberSummary> members) {
  std::vector<ScalarInfo> columns;
  for (const ScalarInfo& scalar : scalar_table())
    if (!scalar.sparse || std::any_of(members.begin(), members.end(), [&](const MemberSummary& m) {
          return !std::isnan(m.scalars.*scalar.field);
        }))
      columns.push_back(scalar);
  return columns;
}

std::string header(const DesignTable& design, std::span<const ScalarInfo> scalars,
                   const ScoreTable* scores) {
  Cells cells{"member", "outcome", "censored", "reason", "formulation"};
  for (const std::string& key : design.keys) cells.push_back(quoted(key));
  for (const ScalarInfo& scalar : scalars) cells.emplace_back(scalar.name);
  if (scores != nullptr) {
    for (const ScoreInfo& score : scores->columns) cells.push_back("score_" + score.name);
    cells.emplace_back("score_bounds");
  }
  cells.insert(cells.end(), {"binding_limit", "warnings", "state_hash"});
  return line_of(cells);
}

void add_scores(const ScoreTable& scores, std::size_t i, Cells& cells) {
  const auto& own = scores.rows.at(i);  // empty without a valid result
  for (std::size_t k = 0; k < scores.columns.size(); ++k)
    cells.push_back(own.empty() ? std::string() : number(own[k].value));
  cells.push_back(quoted(bounds_text(scores, i)));
}

std::string row(const DesignTable& design, std::span<const ScalarInfo> scalars,
                const MemberSummary& m, const ScoreTable* scores, std::size_t i) {
  require(m.member >= 0 && m.member < design.n_members(),
          fmt::format("member {} is not in the design table of {} members (results of another "
                      "ensemble?). Use the directory that the design was written to.",
                      m.member, design.n_members()));
  Cells cells{std::to_string(m.member), std::string(to_string(m.outcome)),
              std::string(to_string(m.censoring)), quoted(m.reason), quoted(m.formulation)};
  for (const double value : design.values[static_cast<std::size_t>(m.member)])
    cells.push_back(number(value));
  const bool has_result = m.outcome != Outcome::failed && m.outcome != Outcome::cancelled;
  for (const ScalarInfo& scalar : scalars)
    cells.push_back(has_result ? number(m.scalars.*scalar.field) : std::string());
  if (scores != nullptr) add_scores(*scores, i, cells);
  cells.push_back(quoted(m.binding_limit));
  cells.push_back(quoted(m.warnings));
  cells.push_back(has_result ? fmt::format("{:016x}", m.state_hash) : std::string());
  return line_of(cells);
}

}  // namespace

std::string members_csv(const DesignTable& design, std::span<const MemberSummary> members,
                        const ScoreTable* scores) {
  std::string text;
  members_csv(design, members, scores, [&](std::string_view piece) { text += piece; });
  return text;
}

void members_csv(const DesignTable& design, std::span<const MemberSummary> members,
                 const ScoreTable* scores, const std::function<void(std::string_view)>& put) {
  constexpr std::size_t piece = std::size_t{1} << 18;
  std::vector<const MemberSummary*> ordered;
  for (const MemberSummary& m : members) ordered.push_back(&m);
  std::sort(ordered.begin(), ordered.end(),
            [](const auto* a, const auto* b) { return a->member < b->member; });
  const std::vector<ScalarInfo> scalars = scalars_of(members);
  std::string text = header(design, scalars, scores);
  for (const MemberSummary* m : ordered) {
    text += row(design, scalars, *m, scores, static_cast<std::size_t>(m - members.data()));
    if (text.size() < piece) continue;
    put(text);
    text.clear();
  }
  put(text);
}

}  // namespace sturz
