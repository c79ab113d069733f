// SPDX-License-Identifier: Apache-2.0
// Members beside what was observed.
#include "engine/core/error.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sturz {
namespace {

constexpr std::size_t most_shown = 10;

/// A value with what is known of it.
std::string known_cell(const Observation& value) {
  if (value.known == Known::exactly || std::isnan(value.value))
    return fmt::format("<td class=\"n\" data-v=\"{:.9g}\">{}</td>", value.value,
                       shown_number(value.value));
  const bool least = value.known == Known::at_least;
  return fmt::format("<td class=\"n\" data-v=\"{:.9g}\" title=\"{}\">{}{}{}</td>", value.value,
                     html_escape(tr(least ? "members.at_least" : "members.of_seen")),
                     least ? "\u2265\u00A0" : "(", shown_number(value.value), least ? "" : ")");
}

std::string head_cell(const std::string& label, const std::string& unit, const std::string& title) {
  const std::string shown = display_unit(unit).label;
  return fmt::format("<th scope=\"col\" title=\"{}\">{}{}</th>", html_escape(title),
                     html_escape(label),
                     shown.empty() ? "" : "<small>" + html_escape(shown) + "</small>");
}

/// The scores that a reader looks for first; the others are in members.csv.
std::vector<std::size_t> shown_scores(const ScoreTable& scores) {
  constexpr std::array tails = {"misfit", "_iou",        "_hit_rate", "_false_alarm_ratio",
                                "_hss",   "_hausdorff_m"};
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < scores.columns.size(); ++k)
    if (std::any_of(tails.begin(), tails.end(),
                    [&](const char* tail) { return scores.columns[k].name.ends_with(tail); }))
      shown.push_back(k);
  return shown;
}

/// Observed quantities with their standard deviations, as the table's first row.
std::string observed_row(const ScoreTable& scores, std::size_t n_before, std::size_t n_scores) {
  std::string row =
      "<tr class=\"observed\"><th scope=\"row\">" + html_escape(tr("observed.row")) + "</th>";
  for (std::size_t i = 1; i < n_before; ++i) row += "<td></td>";
  for (std::size_t i = 0; i < n_scores; ++i) row += "<td></td>";
  for (const ObservedQuantity& q : scores.comparison.observed) {
    const double factor = display_unit(q.unit).factor;
    row += fmt::format("<td class=\"n\">{} \u00B1 {}</td>", shown_number(factor * q.value),
                       shown_number(factor * q.sd));
  }
  return row + "</tr>";
}

std::string member_row(const ReportInput& input, std::size_t i,
                       const std::vector<std::size_t>& shown,
                       const std::vector<Observation>& simulated) {
  const MemberSummary& m = input.members[i];
  std::string row =
      fmt::format("<tr{}><th scope=\"row\" data-v=\"{}\">{}</th>",
                  is_censored(m.censoring) ? " class=\"cut\"" : "", m.member, m.member);
  if (!input.samples.rows.empty())
    for (std::size_t k = 0; k < input.samples.columns.size(); ++k) {
      const double factor =
          k < input.samples.units.size() ? display_unit(input.samples.units[k]).factor : 1;
      row += known_cell({factor * input.samples.rows[i][k], Known::exactly});
    }
  for (const std::size_t k : shown) row += known_cell(input.scores->rows[i][k]);
  for (std::size_t q = 0; q < simulated.size(); ++q) {
    const double factor = display_unit(input.scores->comparison.observed[q].unit).factor;
    row += known_cell({factor * simulated[q].value, simulated[q].known});
  }
  return row + "</tr>";
}

const std::string& good_values(Better better) {
  switch (better) {
    case Better::larger:
      return tr("observed.larger");
    case Better::smaller:
      return tr("observed.smaller");
    case Better::nearer_one:
      return tr("observed.nearer_one");
    case Better::nearer_zero:
      break;
  }
  return tr("observed.nearer_zero");
}

std::string table_head(const ReportInput& input, const std::vector<std::size_t>& shown) {
  std::string head = head_cell(tr("members.col.member"), "", tr("members.col.member_full"));
  if (!input.samples.rows.empty())
    for (std::size_t k = 0; k < input.samples.columns.size(); ++k)
      head += head_cell(key_label(input.samples, k),
                        k < input.samples.units.size() ? input.samples.units[k] : "1",
                        input.samples.columns[k]);
  for (const std::size_t k : shown) {
    const ScoreInfo& score = input.scores->columns[k];
    head += head_cell(words_without_unit(score.name), score.unit,
                      score.long_name + "; " + good_values(score.better));
  }
  for (const ObservedQuantity& q : input.scores->comparison.observed)
    head += head_cell(words_without_unit(q.name), q.unit, tr("observed.compared", q.name));
  return head;
}

/// Where the simulated quantities of member `i` lie.
const std::vector<Observation>& simulated_of(const ReportInput& input, std::size_t i) {
  const SimulatedQuantities& all = input.scores->comparison.simulated;
  const auto found =
      std::lower_bound(all.members.begin(), all.members.end(), input.members[i].member);
  expect(found != all.members.end() && *found == input.members[i].member,
         "a scored member has its quantities");
  return all.values[static_cast<std::size_t>(found - all.members.begin())];
}

}  // namespace

std::string observed_html(const ReportInput& input, const Headline& h) {
  if (input.scores == nullptr) return {};
  const ScoreTable& scores = *input.scores;
  expect(scores.rows.size() == input.members.size(), "report: one row of scores per member");
  std::vector<std::size_t> best = best_rows(scores);
  if (best.empty()) return {};
  const std::size_t all = best.size();
  if (best.size() > most_shown) best.resize(most_shown);
  const std::vector<std::size_t> shown = shown_scores(scores);
  const std::size_t before = 1 + (input.samples.rows.empty() ? 0 : input.samples.columns.size());
  std::string rows = observed_row(scores, before, shown.size());
  for (const std::size_t i : best) rows += member_row(input, i, shown, simulated_of(input, i));
  std::string html = "<section id=\"observed\"><h2>" + html_escape(tr("observed.title")) +
                     "</h2><p class=\"note\">";
  if (h.n_members > 1) html += html_escape(tr("observed.best", best.size(), all));
  html += html_escape(tr("observed.note")) + "</p>";
  return html +
         "<div class=\"table-box short\" tabindex=\"0\"><table id=\"observed-table\" "
         "class=\"spaced\"><thead><tr>" +
         table_head(input, shown) + "</tr></thead><tbody>" + rows +
         "</tbody></table></div></section>";
}

}  // namespace sturz
