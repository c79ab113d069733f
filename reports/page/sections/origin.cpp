// SPDX-License-Identifier: Apache-2.0
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace sturz {
namespace {

std::string list(const std::vector<std::string>& lines) {
  std::string html = "<ul>";
  for (const auto& line : lines) html += "<li>" + html_escape(line) + "</li>";
  return html + "</ul>";
}

std::string timing_table(const NamedSeconds& timings) {
  double total = 0;
  for (const auto& [name, seconds] : timings) total += seconds;
  std::string html = "<table class=\"plain\"><tbody>";
  for (const auto& [name, seconds] : timings) {
    const double share = total > 0 ? seconds / total : 0;
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td><td class=\"n\">{}</td><td>"
        "<svg width=\"72\" height=\"8\" aria-hidden=\"true\"><rect class=\"bar\" height=\"8\" "
        "rx=\"2\" width=\"{:.1f}\"/></svg></td></tr>",
        html_escape(name), duration_text(seconds), html_escape(percent_text(share)), 72 * share);
  }
  return html + "</tbody></table>";
}

/// Begins a column.
std::string heading(const char* key) { return "<div><h3>" + html_escape(tr(key)) + "</h3>"; }

std::string times_html(const ReportInput& input) {
  std::string html = timing_table(input.timings);
  html += "<p class=\"note\">" +
          html_escape(tr("computation.clock",
                         input.hazard != nullptr ? tr("computation.summed") : std::string())) +
          "</p>";
  if (!input.pass_timings.empty())
    html += "<details><summary>" + html_escape(tr("computation.passes")) + "</summary>" +
            timing_table(input.pass_timings) + "</details>";
  return html;
}

}  // namespace

std::string computation_html(const ReportInput& input, const Headline&) {
  if (input.description.empty() && input.timings.empty() && input.notes.empty()) return {};
  std::string html = "<section id=\"computation\"><h2>" + html_escape(tr("computation.title")) +
                     "</h2><details><summary>" + html_escape(tr("computation.fold")) +
                     "</summary><div class=\"columns\">";
  if (!input.description.empty()) {
    html += heading("computation.scene") + "<pre class=\"lines\"" + english_attribute() + ">";
    for (const auto& line : input.description) html += html_escape(line) + "\n";
    html += "</pre></div>";
  }
  if (!input.timings.empty()) html += heading("computation.time") + times_html(input) + "</div>";
  if (input.hazard != nullptr) html += left_out_html(input.members);
  if (!input.notes.empty()) html += heading("computation.input") + list(input.notes) + "</div>";
  return html + "</div></details></section>";
}

namespace {
/// "input elev_12_5m.tif": the name of a file keeps its underscores.
bool is_file(std::string_view key) { return key.starts_with("input "); }
}  // namespace

std::string provenance_html(const ReportInput& input) {
  if (input.manifest.empty() && input.scenario_yaml.empty()) return {};
  std::string html = "<section id=\"origin\"><h2>" + html_escape(tr("origin.title")) + "</h2>";
  if (!input.manifest.empty()) {
    html +=
        "<details><summary>" + html_escape(tr("origin.fold")) + "</summary><dl class=\"manifest\">";
    for (const auto& [key, value] : input.manifest)
      html += "<div><dt>" + html_escape(is_file(key) ? key : words(key)) + "</dt><dd>" +
              html_escape(value) + "</dd></div>";
    html += "</dl></details>";
  }
  if (!input.scenario_yaml.empty())
    html += "<details><summary>" + html_escape(tr("origin.scenario")) + "</summary><pre>" +
            html_escape(input.scenario_yaml) + "</pre></details>";
  return html + "</section>";
}

namespace {

std::vector<std::string> region_reading() {
  return {tr("reading.region.1"), tr("reading.region.2"), tr("reading.region.3"),
          tr("reading.region.4")};
}

}  // namespace

std::string reading_html(const ReportInput& input) {
  const std::string level = percent_text(interval_confidence);
  std::vector<std::string> lines;
  if (input.region != nullptr) {
    lines = region_reading();
  } else if (input.hazard != nullptr) {
    lines = {tr("reading.probability"), tr("reading.intervals", level), tr("reading.medians"),
             tr("reading.cut"), tr("reading.l_and_h")};
  }
  lines.push_back(tr("reading.peaks"));
  lines.push_back(tr("reading.smoothed"));
  if (input.resolved_thickness_m > 0)
    lines.push_back(tr("reading.not_resolved", with_unit(input.resolved_thickness_m, "m")));
  lines.push_back(tr("reading.rounded"));
  return "<section id=\"reading\"><h2>" + html_escape(tr("reading.title")) + "</h2>" + list(lines) +
         "</section>";
}

}  // namespace sturz
