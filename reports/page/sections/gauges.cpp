// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/motion_charts.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace sturz {
namespace {

constexpr std::size_t most_rows = 200, most_charts = 12;

std::string head_of(const GaugeFindings& f) {
  std::string head;
  for (const char* key : {"gauge", "quantity", "unit", "reached"})
    head += "<th scope=\"col\">" + html_escape(tr(fmt::format("gauges.col.{}", key))) + "</th>";
  for (std::size_t k = 0; k < f.quantiles.size(); ++k)
    head +=
        fmt::format("<th scope=\"col\">{}</th>",
                    f.one_member ? html_escape(tr("gauges.col.value"))
                                 : fmt::format("{}\u00A0%", shown_number(100 * f.quantiles[k])));
  return head;
}

/// What stands in gauges.csv in place of a number, in the page's language.
std::string word_of(const std::string& value) {
  if (value == "never") return tr("gauges.never");
  if (value == "not reached") return tr("gauges.not_reached");
  if (value == "not known") return tr("gauges.value_not_known");
  return value;
}

std::string quantity_of(const GaugeRow& row) {
  for (const auto& [name, key] : {std::pair{"arrival", "gauges.arrival"},
                                  {"peak_thickness", "gauges.peak_thickness"},
                                  {"peak_speed", "gauges.peak_speed"},
                                  {"peak_momentum_flux", "gauges.peak_momentum_flux"},
                                  {"peak_discharge", "gauges.peak_discharge"},
                                  {"volume", "gauges.volume"}})
    if (row.quantity == name) return tr(key);
  return words(row.quantity);
}

/// ">= 0.193627" as "\u2265 0.194", in the unit that is shown; words stay as they are.
std::string shown_quantile(const std::string& value, double factor) {
  const std::size_t digits = value.find_first_of("0123456789");
  if (digits == std::string::npos) return word_of(value);
  std::string bound = value.substr(0, digits);
  if (bound == ">= ") bound = "\u2265\u00A0";
  return bound + shown_number(factor * std::strtod(value.c_str() + digits, nullptr));
}

std::string row_of(const GaugeRow& r) {
  const DisplayUnit unit = display_unit(r.units);
  std::string row = fmt::format(
      "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td>", html_escape(r.gauge),
      html_escape(quantity_of(r)), html_escape(unit.label),
      html_escape(tr("gauges.of", r.reached, r.members,
                     r.unknown > 0 ? tr("gauges.not_known", r.unknown) : std::string())));
  for (const std::string& v : r.values)
    row += fmt::format("<td class=\"n\">{}</td>", html_escape(shown_quantile(v, unit.factor)));
  return row + "</tr>";
}

/// From when on which members are not known any more; empty where all are throughout.
std::string unknown_text(const GaugeBand& band, std::size_t n_members) {
  const auto fewer = std::find_if(band.members.begin(), band.members.end(),
                                  [&](std::size_t known) { return known < n_members; });
  if (fewer == band.members.end()) return {};
  const auto first = static_cast<std::size_t>(fewer - band.members.begin());
  const std::size_t least = *std::min_element(fewer, band.members.end());
  const std::string from = duration_text(band.time_s[first]);
  return least == 0 && *fewer == 0 ? tr("gauges.gap", from)
         : least == 0              ? tr("gauges.fewer_gap", from, n_members)
                                   : tr("gauges.fewer", from, least, n_members);
}

/// Discharge of a line over time, its quantiles as lines.
std::string chart_of(const GaugeFindings& f, const GaugeBand& band) {
  std::size_t n_members = 0;
  for (const GaugeRow& row : f.rows)
    if (row.gauge == band.gauge) n_members = std::max(n_members, row.members);
  constexpr std::array<const char*, 3> paints{"rear", "front", "fastest"};
  MotionChart chart;
  chart.name = "gauge";
  chart.title = tr("gauges.chart", band.gauge);
  chart.unit = "m\u00B3/s";
  double most = 0;
  for (std::size_t q = 0; q < band.values.size() && q < paints.size(); ++q) {
    MotionLine line;
    line.label =
        f.one_member ? tr("gauges.discharge") : fmt::format("{:g} %", 100 * f.quantiles[q]);
    line.paint = paints[q];
    line.values = band.values[q];
    for (const double v : line.values)
      if (v > most) most = v;
    chart.lines.push_back(std::move(line));
  }
  if (!(most > 0) || band.time_s.size() < 2) return {};
  chart.top = round_top(most);
  std::string legend = "<ul class=\"legend\">";
  for (const MotionLine& line : chart.lines)
    legend += fmt::format(
        "<li><svg class=\"chip\" width=\"22\" height=\"12\" aria-hidden=\"true\"><rect "
        "class=\"area paint-{}\" width=\"22\" height=\"12\" rx=\"2\"/></svg>{}</li>",
        line.paint, html_escape(line.label));
  const std::string unknown = unknown_text(band, n_members);
  return fmt::format(
      "<figure class=\"chart motion\"><figcaption>{}</figcaption>{}{}</ul>{}</figure>",
      html_escape(chart.title), motion_chart_svg(chart, band.time_s), legend,
      unknown.empty() ? "" : "<p class=\"note\">" + html_escape(unknown) + "</p>");
}

}  // namespace

std::string gauges_html(const ReportInput& input) {
  if (input.gauges == nullptr || input.gauges->empty()) return {};
  const GaugeFindings& f = *input.gauges;
  std::string html = "<section id=\"gauges\"><h2>" + html_escape(tr("gauges.title")) +
                     "</h2><div class=\"table-box short\" tabindex=\"0\">"
                     "<table class=\"spaced\"><thead><tr>" +
                     head_of(f) + "</tr></thead><tbody>";
  for (std::size_t k = 0; k < std::min(most_rows, f.rows.size()); ++k) html += row_of(f.rows[k]);
  html += "</tbody></table></div><div class=\"charts motion\">";
  std::size_t charts = 0;
  for (const GaugeBand& band : f.bands)
    if (band.quantity == "discharge" && charts++ < most_charts) html += chart_of(f, band);
  return html + "</div><p class=\"note\">" + html_escape(tr("gauges.note")) + "</p></section>";
}

}  // namespace sturz
