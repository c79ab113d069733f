// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/score_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace sturz {
namespace {

/// A stored member, with its maps as far as they are looked at.
class StoredMember {
 public:
  StoredMember(const MemberParts& source, std::size_t row, const std::vector<PeakLayer>& layers) {
    const MemberSummary& m = source.members()[row];
    view_ = view_of(m);
    for (const PeakLayer layer : layers) {
      if (!is_kept(layer, m.censoring, m.scalars) || m.window.n_cells() == 0) continue;
      auto& values = values_[static_cast<std::size_t>(layer)];
      values.resize(m.window.n_cells());
      source.read_part(row, layer, m.window, values);
      view_.layers[static_cast<std::size_t>(layer)] = values;
    }
  }
  const MemberView& view() const { return view_; }

 private:
  std::array<std::vector<float>, n_peak_layers> values_;
  MemberView view_;
};

void take(ScoreSheet sheet, const MemberSummary& m, ScoreTable& table) {
  table.rows.push_back(std::move(sheet.scores));
  table.comparison.simulated.members.push_back(m.member);
  table.comparison.simulated.values.push_back(std::move(sheet.simulated));
}

/// Columns and quantities, from a member that did nothing.
ScoreTable empty_table(const EventScorer& scorer) {
  ScoreSheet sheet = scorer.score(MemberView());
  ScoreTable table;
  table.columns = std::move(sheet.columns);
  table.comparison.observed = std::move(sheet.observed);
  return table;
}

}  // namespace

std::optional<std::size_t> ScoreTable::column(const std::string& name) const {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == name) return i;
  return std::nullopt;
}

ScoreTable score_members(const MemberParts& source, std::shared_ptr<const ObservedEvent> event,
                         CancelFlag cancel) {
  Window touched;
  for (const MemberSummary& m : source.members())
    if (is_valid(m.outcome)) touched = joined(touched, m.window);
  const EventScorer scorer(std::move(event), source.grid(), touched);
  ScoreTable table = empty_table(scorer);
  for (std::size_t row = 0; row < source.members().size(); ++row) {
    cancel.check();
    const MemberSummary& m = source.members()[row];
    if (is_valid(m.outcome))
      take(scorer.score(StoredMember(source, row, scorer.layers()).view()), m, table);
    else
      table.rows.emplace_back();
  }
  return table;
}

ScoreTable score_result(const MemberResult& result, std::shared_ptr<const ObservedEvent> event) {
  const EventScorer scorer(std::move(event), result.grid, result.window);
  ScoreTable table = empty_table(scorer);
  MemberSummary summary;
  summary.member = result.member;
  if (is_valid(result.outcome))
    take(scorer.score(view_of(result)), summary, table);
  else
    table.rows.emplace_back();
  return table;
}

std::vector<std::size_t> best_rows(const ScoreTable& table) {
  std::vector<std::size_t> rows;
  const auto misfit = table.column("misfit");
  if (!misfit) return rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (!table.rows[i].empty()) rows.push_back(i);
  const auto rank = [&](std::size_t i) {
    const Observation& m = table.rows[i][*misfit];
    return std::pair(m.known,
                     std::isnan(m.value) ? std::numeric_limits<double>::infinity() : m.value);
  };
  std::stable_sort(rows.begin(), rows.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return rows;
}

Raster<std::uint8_t> shown_cells(const MemberParts& source, std::size_t row,
                                 std::shared_ptr<const ObservedEvent> event) {
  const EventScorer scorer(std::move(event), source.grid(), Window());
  return scorer.shown_cells(StoredMember(source, row, scorer.layers()).view());
}

std::string bounds_text(const ScoreTable& table, std::size_t row) {
  std::string text;
  for (const auto& [known, words] :
       {std::pair(Known::at_least, "at least: "), std::pair(Known::not_at_all, "not known: ")}) {
    std::string names;
    for (std::size_t k = 0; k < table.rows[row].size(); ++k)
      if (table.rows[row][k].known == known)
        names += (names.empty() ? "" : ", ") + table.columns[k].name;
    if (!names.empty()) text += (text.empty() ? "" : "; ") + (words + names);
  }
  return text;
}

}  // namespace sturz
