// SPDX-License-Identifier: Apache-2.0
// The sources of a region: which were computed, and how far they reach.
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"

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
    return row + "<td colspan=\"5\">not computed: " + html_escape(s.failure) + "</td></tr>";
  if (s.valid == 0) return row + "<td colspan=\"5\">no valid simulation</td></tr>";
  const char* least = s.cut_off > 0 ? "\u2265\u00A0" : "";
  return row +
         cell(fmt::format("{} of {}", s.valid, s.planned) +
              (s.cut_off > 0 ? fmt::format(", {} cut off", s.cut_off) : "")) +
         cell(std::isnan(s.release_volume_m3) ? "\u2013" : shown_number(s.release_volume_m3)) +
         cell(least + area_text(s.possible_area_m2)) + cell(least + area_text(s.likely_area_m2)) +
         cell(area_text(s.likeliest_area_m2)) + "</tr>";
}

}  // namespace

std::string sources_html(const ReportInput& input) {
  if (input.region == nullptr) return {};
  const RegionShown& region = *input.region;
  std::string html =
      "<section id=\"sources\"><h2>Sources</h2><div class=\"table-box\" tabindex=\"0\"><table "
      "class=\"spaced\"><thead><tr><th scope=\"col\">source</th><th scope=\"col\">number</th>"
      "<th scope=\"col\">valid simulations</th><th scope=\"col\">release of the first "
      "<small>m\u00B3</small></th><th scope=\"col\">reached by any</th>"
      "<th scope=\"col\">reached by half</th><th scope=\"col\">likeliest source "
      "of</th></tr></thead>"
      "<tbody>";
  for (std::size_t i = 0; i < std::min(most_rows, region.sources.size()); ++i)
    html += row_of(region.sources[i], i + 1);
  html +=
      "</tbody></table></div><p class=\"note\">Click a cell of the map to see which sources reach "
      "it. All sources are in sources.csv; the members of each are an ordinary ensemble in its "
      "folder under features/, of which <code>sturz merge</code> makes maps of its own.";
  if (region.sources.size() > most_rows)
    html += fmt::format(" Here are the first {} of {}.", most_rows, region.sources.size());
  return html + "</p></section>";
}

}  // namespace sturz
