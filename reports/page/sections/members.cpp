// SPDX-License-Identifier: Apache-2.0
#include "engine/core/error.hpp"
#include "ensemble/censoring/scalar_censoring.hpp"
#include "reports/page/cut_off_text.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <vector>

namespace sturz {
namespace {

constexpr std::size_t max_rows = 500;

struct ScalarColumn {
  const char* key;  ///< of its label among the texts: members.col.KEY
  const char* units;
  double MemberScalars::*field;
  bool percent = false;   ///< a share, shown to compare members, where some member has one
  bool optional = false;  ///< shown where some member has one
};
constexpr ScalarColumn scalar_columns[] = {
    {"runout", "m", &MemberScalars::runout_m},
    {"length", "m", &MemberScalars::crown_to_toe_length_m},
    {"ratio", "1", &MemberScalars::crown_to_toe_ratio},
    {"com", "m", &MemberScalars::com_travel_m},
    {"area", "m2", &MemberScalars::reached_area_m2},
    {"speed", "m s-1", &MemberScalars::max_speed_m_s},
    {"thickness", "m", &MemberScalars::max_thickness_m},
    {"energy", "J m-2", &MemberScalars::max_energy_j_m2},
    {"eroded", "m3", &MemberScalars::eroded_volume_m3, false, true},
    {"growth", "1", &MemberScalars::volume_growth, false, true},
    {"solid_runout", "m", &MemberScalars::solid_runout_m, false, true},
    {"liquid_runout", "m", &MemberScalars::liquid_runout_m, false, true},
    {"solid_left", "1", &MemberScalars::solid_lost_fraction, true, true},
    {"liquid_left", "1", &MemberScalars::liquid_lost_fraction, true, true},
    {"layers", "1", &MemberScalars::release_layers},
    {"dilated", "1", &MemberScalars::parted_fraction, true},
    {"transition", "1", &MemberScalars::transition_fraction, true},
    {"dilute", "1", &MemberScalars::dilute_fraction, true},
    {"ultradilute", "1", &MemberScalars::ultradilute_fraction, true},
    {"simulated", "s", &MemberScalars::end_time_s},
    {"steps", "1", &MemberScalars::n_steps},
    {"wall", "s", &MemberScalars::wall_s},
    {"cpu", "s", &MemberScalars::cpu_s},
};

std::string header_cell(const std::string& label, const std::string& unit,
                        const std::string& full_name) {
  return fmt::format("<th scope=\"col\" title=\"{}\">{}{}</th>", html_escape(full_name),
                     html_escape(label),
                     unit.empty() ? "" : "<small>" + html_escape(unit) + "</small>");
}

std::string number_cell(double value) {
  return fmt::format("<td class=\"n\" data-v=\"{:.9g}\">{}</td>", value, shown_number(value));
}

/// A scalar of a member as far as it is known.
std::string scalar_cell(double value, Known known) {
  if (known == Known::exactly || std::isnan(value)) return number_cell(value);
  const bool least = known == Known::at_least;
  return fmt::format("<td class=\"n\" data-v=\"{:.9g}\" title=\"{}\">{}{}{}</td>", value,
                     html_escape(tr(least ? "members.at_least" : "members.of_seen")),
                     least ? "\u2265\u00A0" : "(", shown_number(value), least ? "" : ")");
}

std::string unit_of(const ReportTable& table, std::size_t k) {
  return k < table.units.size() ? table.units[k] : "1";
}

/// Whether some member's value says yes.
template <class Says>
bool some(const std::vector<MemberSummary>& members, const ScalarColumn& c, Says says) {
  return std::any_of(members.begin(), members.end(),
                     [&](const MemberSummary& m) { return says(m.scalars.*c.field); });
}

/// Columns that say something about these members.
std::vector<ScalarColumn> shown_columns(const std::vector<MemberSummary>& members) {
  std::vector<ScalarColumn> shown;
  for (const ScalarColumn& c : scalar_columns) {
    if (c.optional && !some(members, c, [](double v) { return !std::isnan(v); })) continue;
    const bool compares = members.size() > 1 && some(members, c, [](double v) { return v > 0; });
    if (!c.percent || compares) shown.push_back(c);
  }
  return shown;
}

std::string unit_of(const ScalarColumn& c) { return c.percent ? "%" : display_unit(c.units).label; }
double factor_of(const ScalarColumn& c) { return c.percent ? 100 : display_unit(c.units).factor; }

std::string label_of(const ScalarColumn& c) { return tr(fmt::format("members.col.{}", c.key)); }

std::string full_name(const ScalarColumn& c) {
  if (!c.percent) return label_of(c);
  for (const ScalarInfo& scalar : scalar_table())
    if (scalar.field == c.field) return scalar.long_name;
  return label_of(c);
}

/// The scores by which a reader sorts members; the others are in members.csv.
std::vector<std::size_t> sorting_scores(const ReportInput& input) {
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; input.scores != nullptr && k < input.scores->columns.size(); ++k)
    if (const std::string& name = input.scores->columns[k].name;
        name == "misfit" || name.ends_with("_iou"))
      shown.push_back(k);
  return shown;
}

std::string score_heads(const ReportInput& input) {
  std::string heads;
  for (const std::size_t k : sorting_scores(input)) {
    const ScoreInfo& score = input.scores->columns[k];
    heads += header_cell(words(score.name), "", score.long_name);
  }
  return heads;
}

std::string score_cells(const ReportInput& input, std::size_t i) {
  std::string cells;
  for (const std::size_t k : sorting_scores(input)) {
    const auto& own = input.scores->rows.at(i);
    cells += own.empty() ? number_cell(nan_d) : scalar_cell(own[k].value, own[k].known);
  }
  return cells;
}

std::string table_head(const ReportTable& samples, bool with_samples,
                       const std::vector<ScalarColumn>& columns) {
  std::string head;
  for (const char* key : {"member", "outcome", "cut"})
    head += header_cell(tr(fmt::format("members.col.{}", key)), "",
                        tr(fmt::format("members.col.{}_full", key)));
  for (std::size_t k = 0; with_samples && k < samples.columns.size(); ++k)
    head += header_cell(key_label(samples, k), display_unit(unit_of(samples, k)).label,
                        samples.columns[k]);
  for (const auto& c : columns) head += header_cell(label_of(c), unit_of(c), full_name(c));
  return head;
}

std::string row_class(const MemberSummary& m) {
  if (!is_valid(m.outcome)) return " class=\"lost\"";
  return is_censored(m.censoring) ? " class=\"cut\"" : "";
}

/// What colour says, said without it.
const char* mark_of(const MemberSummary& m) {
  if (!is_valid(m.outcome)) return "\u2715\u00A0";
  return is_censored(m.censoring) ? "\u2192\u00A0" : "";
}

std::string table_row(const ReportInput& input, std::size_t i,
                      const std::vector<ScalarColumn>& columns) {
  const MemberSummary& m = input.members[i];
  std::string row = fmt::format(
      "<tr{}><td class=\"n\" data-v=\"{}\">{}</td><td title=\"{}\">{}{}</td><td>{}</td>",
      row_class(m), m.member, m.member, html_escape(m.reason), mark_of(m),
      html_escape(outcome_text(m.outcome)), html_escape(censoring_text(m.censoring)));
  if (!input.samples.rows.empty())
    for (std::size_t k = 0; k < input.samples.columns.size(); ++k)
      row += number_cell(display_unit(unit_of(input.samples, k)).factor * input.samples.rows[i][k]);
  const bool has_scalars = m.outcome != Outcome::failed && m.outcome != Outcome::cancelled;
  for (const auto& c : columns)
    row += scalar_cell(has_scalars ? factor_of(c) * m.scalars.*c.field : nan_d,
                       known(c.field, m.scalars, m.censoring));
  return row + score_cells(input, i) + "</tr>";
}

std::string lost_members(const std::vector<MemberSummary>& members) {
  std::string items;
  for (const auto& m : members)
    if (!is_valid(m.outcome))
      items +=
          fmt::format("<li><b>{}</b> {}: {}</li>", m.member, html_escape(outcome_text(m.outcome)),
                      html_escape(m.reason.empty() ? tr("members.no_reason") : m.reason));
  if (items.empty()) return {};
  return "<h3>" + html_escape(tr("members.left_out")) + "</h3><ul class=\"lost-list\">" + items +
         "</ul>";
}

}  // namespace

std::string key_label(const ReportTable& samples, std::size_t column) {
  const auto last_part = [](const std::string& path) {
    const std::size_t dot = path.rfind('.');
    return dot == std::string::npos ? path : path.substr(dot + 1);
  };
  const std::string own = last_part(samples.columns[column]);
  const auto same = std::count_if(samples.columns.begin(), samples.columns.end(),
                                  [&](const auto& path) { return last_part(path) == own; });
  std::string label = same > 1 ? samples.columns[column] : own;
  std::replace(label.begin(), label.end(), '.', ' ');
  // Keys end in their unit, which stands beside the label already.
  for (const char* unit :
       {"_kg_m3", "_m_s2", "_m_s", "_m3", "_m2", "_pa_s", "_pa", "_deg", "_per_m", "_m", "_s"})
    if (column < samples.units.size() && !display_unit(samples.units[column]).label.empty() &&
        label.ends_with(unit)) {
      label.erase(label.size() - std::string_view(unit).size());
      break;
    }
  return words(label);
}

std::string members_html(const ReportInput& input, const Headline& h) {
  const std::size_t n = input.members.size();
  if (n == 0) return {};
  expect(input.samples.rows.empty() || input.samples.rows.size() == n,
         "report: one row of samples per member");
  // Failed members first where the table must be cut: they are what a reader looks for.
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  if (n > max_rows) {
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t i) { return !is_valid(input.members[i].outcome); });
    order.resize(max_rows);
    std::sort(order.begin(), order.end());
  }
  const std::vector<ScalarColumn> columns = shown_columns(input.members);
  std::string rows;
  for (const std::size_t i : order) rows += table_row(input, i, columns);
  std::string html =
      fmt::format("<section id=\"members\"><h2>{}</h2>{}",
                  html_escape(tr(h.n_members == 1 ? "members.title_single" : "members.title")),
                  lost_members(input.members));
  if (n > max_rows)
    html += "<p class=\"note\">" + html_escape(tr("members.cut_table", max_rows, n)) + "</p>";
  if (h.n_members > h.n_valid || h.censoring.censored() > 0)
    html += "<p class=\"note\">" + html_escape(tr("members.marks")) + "</p>";
  return html +
         (n > 1 ? "<div class=\"table-box\" tabindex=\"0\">"
                : "<div class=\"table-box short\" tabindex=\"0\">") +
         "<table id=\"member-table\"><thead><tr>" +
         table_head(input.samples, !input.samples.rows.empty(), columns) + score_heads(input) +
         "</tr></thead><tbody>" + rows + "</tbody></table></div></section>";
}

}  // namespace sturz
