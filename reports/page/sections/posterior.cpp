// SPDX-License-Identifier: Apache-2.0
// What the observations tell of the uncertain values.
#include "reports/figures/posterior_figures.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sturz {
namespace {

using Column = std::vector<double>;

/// From the stored unit to the one that the label names.
double factor_of(const ReportTable& table, std::size_t k) {
  return k < table.units.size() ? display_unit(table.units[k]).factor : 1;
}

Column column_of(const ReportTable& table, std::size_t k) {
  Column column;
  for (const auto& row : table.rows) column.push_back(factor_of(table, k) * row[k]);
  return column;
}

std::string label_of(const ReportTable& table, std::size_t k) {
  const std::string unit = k < table.units.size() ? display_unit(table.units[k]).label : "";
  return key_label(table, k) + (unit.empty() ? "" : " [" + unit + "]");
}

std::string figure(const std::string& title, const std::string& svg) {
  if (svg.empty()) return {};
  return fmt::format("<figure class=\"chart\"><figcaption>{}</figcaption>{}</figure>",
                     html_escape(title), svg);
}

/// Before: what the members drew. Their columns are those of the posterior, in the same order.
std::string figures(const ReportTable& before, const ReportTable& after) {
  std::vector<Column> was, is;
  for (std::size_t k = 0; k < after.columns.size(); ++k) {
    was.push_back(before.rows.empty() ? Column{} : column_of(before, k));
    is.push_back(column_of(after, k));
  }
  std::string html = "<div class=\"charts posterior\">";
  for (std::size_t k = 0; k < is.size(); ++k)
    html += figure(key_label(after, k), marginal_svg(was[k], is[k], label_of(after, k)));
  for (std::size_t b = 1; b < is.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      html +=
          figure(tr("posterior.against", key_label(after, b), key_label(after, a)),
                 pair_svg(was[a], was[b], is[a], is[b], label_of(after, a), label_of(after, b)));
  return html + "</div>";
}

/// \param v 5 %, 50 %, 95 %, in the stored unit
std::string interval(const double (&v)[3], double factor) {
  return fmt::format("{} ({} \u2013 {})", shown_number(factor * v[1]), shown_number(factor * v[0]),
                     shown_number(factor * v[2]));
}

bool any_best(const PosteriorShown& p) {
  return std::any_of(p.keys.begin(), p.keys.end(),
                     [](const PosteriorShown::Key& k) { return std::isfinite(k.best); });
}

/// With its explanation, where it has one.
std::string head_cell(const char* name) {
  const std::string key = fmt::format("posterior.col.{}", name);
  const std::string full = key + "_full";
  return "<th scope=\"col\"" +
         (has_text(full) ? " title=\"" + html_escape(tr(full)) + "\">" : std::string(">")) +
         html_escape(tr(key)) + "</th>";
}

std::string keys_table(const PosteriorShown& p) {
  const bool best = any_best(p);
  std::string html =
      "<div class=\"table-box short\" tabindex=\"0\"><table class=\"spaced\"><thead><tr>" +
      head_cell("value") + head_cell("before") + head_cell("after") + head_cell("told");
  if (best) html += head_cell("best");
  html += "</tr></thead><tbody>";
  for (std::size_t k = 0; k < p.keys.size(); ++k) {
    const PosteriorShown::Key& key = p.keys[k];
    const double factor = factor_of(p.rows, k);
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td><td class=\"n\">{}</td>"
        "<td class=\"n\">{}</td>",
        html_escape(label_of(p.rows, k)), interval(key.before, factor), interval(key.after, factor),
        html_escape(percent_text(key.variance_removed)));
    if (best) html += fmt::format("<td class=\"n\">{}</td>", shown_number(factor * key.best));
    html += "</tr>";
  }
  return html + "</tbody></table></div>";
}

/// What the emulator expects of the best fit, and what its member gave.
std::string best_text(const PosteriorShown::Quantity& q, double factor) {
  std::string text = shown_number(factor * q.best_expected);
  if (q.best_computed.empty() && std::isnan(q.best_member)) return text;
  const std::string gave = std::isnan(q.best_member) ? "" : shown_number(factor * q.best_member);
  const char* gap = q.best_computed.empty() || gave.empty() ? "" : " ";
  return tr("posterior.member", text, q.best_computed, gap, gave);
}

std::string q2_text(const PosteriorShown::Quantity& q) {
  if (std::isnan(q.q2)) return "\u2013";
  return shown_number(q.q2, 2) + (q.has_step ? tr("posterior.two_sides") : std::string());
}

std::string discrepancy_html(const PosteriorShown& p) {
  if (!(p.discrepancy_scale > 0))
    return "<p>" + html_escape(tr("posterior.no_discrepancy")) + "</p>";
  std::string pieces;
  for (const PosteriorShown::Discrepancy& d : p.discrepancies)
    pieces += fmt::format("{}{} {} ({} \u2013 {})", pieces.empty() ? "" : ", ",
                          words_without_unit(d.kind), percent_text(d.mean), percent_text(d.lower),
                          percent_text(d.upper));
  return "<p>" +
         html_escape(tr("posterior.discrepancy", percent_text(p.discrepancy_scale), pieces)) +
         "</p>";
}

std::string check_table(const PosteriorShown& p) {
  const bool best = any_best(p);
  bool ends_at_zero = false, has_step = false;
  std::string html =
      "<h3>" + html_escape(tr("posterior.check")) +
      "</h3><div class=\"table-box short\" tabindex=\"0\"><table class=\"spaced\"><thead><tr>" +
      head_cell("quantity") + head_cell("observed") + head_cell("predicted") + head_cell("without");
  if (best) html += head_cell("at_best") + head_cell("q2");
  html += "</tr></thead><tbody>";
  for (const PosteriorShown::Quantity& q : p.quantities) {
    const auto [label, factor] = display_unit(q.unit);
    const std::string unit = label;
    html += fmt::format(
        "<tr><th scope=\"row\">{}{}</th><td class=\"n\">{}</td><td class=\"n\">{}</td>"
        "<td class=\"n\">{}</td>",
        html_escape(words_without_unit(q.name)), unit.empty() ? "" : " [" + html_escape(unit) + "]",
        shown_number(factor * q.observed), interval(q.check, factor),
        q.has_held_out ? interval(q.held_out, factor) : "\u2013");
    if (best)
      html += fmt::format("<td class=\"n\">{}</td><td class=\"n\">{}</td>", best_text(q, factor),
                          q2_text(q));
    html += "</tr>";
    ends_at_zero = ends_at_zero || q.ends_at_zero;
    has_step = has_step || q.has_step;
  }
  html += "</tbody></table></div>";
  if (ends_at_zero) html += "<p class=\"note\">" + html_escape(tr("posterior.zero")) + "</p>";
  if (has_step) html += "<p class=\"note\">" + html_escape(tr("posterior.sides")) + "</p>";
  html += discrepancy_html(p);
  if (p.reliability.empty()) return html;
  std::string pieces;
  for (const auto& [nominal, inside] : p.reliability)
    pieces += (pieces.empty() ? "" : ", ") +
              tr("posterior.of_intervals", percent_text(inside), percent_text(nominal));
  return html + "<p class=\"note\">" + html_escape(tr("posterior.reliability", pieces)) + "</p>";
}

}  // namespace

std::string posterior_html(const ReportInput& input) {
  if (input.posterior == nullptr) return {};
  const PosteriorShown& p = *input.posterior;
  std::string html = "<section id=\"posterior\"><h2>" + html_escape(tr("posterior.title")) +
                     "</h2><p>" + html_escape(p.origin) + "</p>";
  if (!p.warnings.empty()) {
    html += "<div class=\"warnings\"><ul>";
    for (const std::string& warning : p.warnings) html += "<li>" + html_escape(warning) + "</li>";
    html += "</ul></div>";
  }
  html += keys_table(p);
  for (const std::string& ridge : p.ridges) html += "<p>" + html_escape(ridge) + "</p>";
  const bool same = input.samples.columns == p.rows.columns;
  html += figures(same ? input.samples : ReportTable{}, p.rows) + "<p class=\"note\">" +
          html_escape(tr("posterior.note")) + "</p>" + check_table(p);
  return html + "</section>";
}

}  // namespace sturz
