// SPDX-License-Identifier: Apache-2.0
// Which ranges the uncertain values were drawn from, for the printed page of numbers.
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <algorithm>

namespace sturz {
namespace {

constexpr std::size_t most_rows = 10;  // that a sheet holds beside cards and warnings

std::string row_of(const ReportTable& samples, std::size_t k) {
  std::vector<double> drawn;
  for (const auto& row : samples.rows) drawn.push_back(row[k]);
  std::sort(drawn.begin(), drawn.end());
  const std::string units = k < samples.units.size() ? samples.units[k] : "1";
  const DisplayUnit unit = display_unit(units);
  std::string cells;
  for (const double v : {drawn.front(), drawn[drawn.size() / 2], drawn.back()})
    cells += "<td class=\"n\">" + shown_number(unit.factor * v) + "</td>";
  return "<tr><th scope=\"row\">" + html_escape(key_label(samples, k)) + "</th><td>" +
         html_escape(unit.label) + "</td>" + cells + "</tr>";
}

}  // namespace

std::string ranges_html(const ReportInput& input) {
  const ReportTable& samples = input.samples;
  if (samples.rows.empty() || samples.columns.empty()) return {};
  std::string html = "<section class=\"print-only\"><h3>" + html_escape(tr("ranges.title")) +
                     "</h3><table class=\"spaced\"><thead><tr>";
  for (const char* key :
       {"ranges.value", "ranges.unit", "ranges.least", "ranges.middle", "ranges.most"})
    html += "<th scope=\"col\">" + html_escape(tr(key)) + "</th>";
  html += "</tr></thead><tbody>";
  for (std::size_t k = 0; k < std::min(most_rows, samples.columns.size()); ++k)
    html += row_of(samples, k);
  html += "</tbody></table>";
  if (samples.columns.size() > most_rows)
    html += "<p class=\"note\">" +
            html_escape(tr("table.first_of", most_rows, samples.columns.size())) + "</p>";
  return html + "</section>";
}

}  // namespace sturz
