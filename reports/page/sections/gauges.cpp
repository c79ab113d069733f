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

/// ">= 0.193627" as "\u2265 0.194", in the unit that is shown; words stay as they are.
std::string shown_quantile(const std::string& value, double factor) {
  const std::size_t digits = value.find_first_of("0123456789");
  if (digits == std::string::npos) return value;
  std::string bound = value.substr(0, digits);
  if (bound == ">= ") bound = "\u2265\u00A0";
  return bound + shown_number(factor * std::strtod(value.c_str() + digits, nullptr));
}

std::string row_of(const GaugeRow& r) {
  const DisplayUnit unit = display_unit(r.units);
  std::string row = fmt::format(
      "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td>", html_escape(r.gauge),
      html_escape(words(r.quantity)), html_escape(unit.label),
      html_escape(tr("gauges.of", r.reached, r.members,
                     r.unknown > 0 ? tr("gauges.not_known", r.unknown) : std::string())));
  for (const std::string& v : r.values)
    row += fmt::format("<td class=\"n\">{}</td>", html_escape(shown_quantile(v, unit.factor)));
  return row + "</tr>";
}

/// Discharge of a line over time, its quantiles as lines.
std::string chart_of(const GaugeFindings& f, const GaugeBand& band) {
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
    for (const double v : band.values[q]) {
      line.values.push_back(std::isnan(v) ? 0 : v);
      most = std::max(most, line.values.back());
    }
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
  return fmt::format("<figure class=\"chart motion\"><figcaption>{}</figcaption>{}{}</ul></figure>",
                     html_escape(chart.title), motion_chart_svg(chart, band.time_s), legend);
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
