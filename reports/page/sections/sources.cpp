// SPDX-License-Identifier: Apache-2.0
// The sources of a region: which were computed, and how far they reach.
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr std::size_t most_rows = 1000;

std::string cell(const std::string& text) { return "<td class=\"n\">" + text + "</td>"; }

std::string row_of(const RegionShown::Source& s, std::size_t number) {
  std::string row =
      fmt::format("<tr{}><th scope=\"row\">{}</th>{}", s.cut_off > 0 ? " class=\"cut\"" : "",
                  html_escape(s.name), cell(std::to_string(number)));
  if (!s.failure.empty())
    return row + "<td colspan=\"5\">" + html_escape(tr("sources.not_computed", s.failure)) +
           "</td></tr>";
  if (s.valid == 0)
    return row + "<td colspan=\"5\">" + html_escape(tr("sources.no_valid")) + "</td></tr>";
  const char* least = s.cut_off > 0 ? "\u2265\u00A0" : "";
  return row +
         cell(tr("sources.of", s.valid, s.planned) +
              (s.cut_off > 0 ? tr("sources.cut", s.cut_off) : std::string())) +
         cell(std::isnan(s.release_volume_m3) ? "\u2013" : shown_number(s.release_volume_m3)) +
         cell(least + area_text(s.possible_area_m2)) + cell(least + area_text(s.likely_area_m2)) +
         cell(area_text(s.likeliest_area_m2)) + "</tr>";
}

}  // namespace

std::string sources_html(const ReportInput& input) {
  if (input.region == nullptr) return {};
  const RegionShown& region = *input.region;
  std::string html =
      "<section id=\"sources\"><h2>" + html_escape(tr("sources.title")) +
      "</h2><div class=\"table-box\" tabindex=\"0\"><table class=\"spaced\"><thead><tr>";
  for (const std::string_view key :
       {"source", "number", "valid", "release", "any", "half", "likeliest"})
    html += "<th scope=\"col\">" + html_escape(tr(fmt::format("sources.col.{}", key))) +
            (key == "release" ? " <small>m\u00B3</small></th>" : "</th>");
  html += "</tr></thead><tbody>";
  for (std::size_t i = 0; i < std::min(most_rows, region.sources.size()); ++i)
    html += row_of(region.sources[i], i + 1);
  html += "</tbody></table></div><p class=\"note\">" + tr("sources.note");
  if (region.sources.size() > most_rows)
    html += tr("table.first_of", most_rows, region.sources.size());
  return html + "</p></section>";
}

}  // namespace sturz
