// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/scalar_censoring.hpp"
#include "reports/page/estimate_text.hpp"
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

using M = MemberScalars;

/// One quantity of the flow and of its materials.
struct PhaseRow {
  const char* key;  ///< of its text: phases.row.KEY
  const char* units;
  double M::*flow;  ///< null: not to be compared
  double M::*grains;
  double M::*liquid;
  bool percent = false;
};
constexpr std::array rows{
    PhaseRow{"runout", "m", &M::runout_m, &M::solid_runout_m, &M::liquid_runout_m},
    PhaseRow{"area", "m2", &M::reached_area_m2, &M::solid_reached_area_m2,
             &M::liquid_reached_area_m2},
    PhaseRow{"thickness", "m", &M::max_thickness_m, &M::max_solid_thickness_m,
             &M::max_liquid_thickness_m},
    PhaseRow{"speed", "m s-1", nullptr, &M::max_solid_speed_m_s, &M::max_liquid_speed_m_s},
    PhaseRow{"energy", "J m-2", &M::max_energy_j_m2, &M::max_solid_energy_j_m2,
             &M::max_liquid_energy_j_m2},
    PhaseRow{"pressure", "Pa", &M::max_pressure_pa, &M::max_solid_pressure_pa,
             &M::max_liquid_pressure_pa},
    PhaseRow{"left", "1", &M::lost_fraction, &M::solid_lost_fraction, &M::liquid_lost_fraction,
             true},
};
constexpr std::array<double, 3> levels{0.05, 0.5, 0.95};

std::string text_of(const PhaseRow& row, double value) {
  if (row.percent) return percent_text(value);
  if (std::string_view(row.units) == "m2") return area_text(value);
  return with_unit(value, row.units);
}

std::string cells_of(const ReportInput& input, const PhaseRow& row, double M::*field, bool single) {
  const std::vector<Observation> sample = observations(input.members, field);
  const NumberWriter number = [&row](double value) { return text_of(row, value); };
  std::string cells, cut;
  for (const double level : levels) {
    if (single && level != 0.5) continue;
    const CensoredEstimate e = censored_quantile(sample, level, interval_confidence);
    cells += fmt::format("<td class=\"n\">{}</td>", html_escape(value_text(e, number)));
    cut = cut_text(e);
  }
  if (!single) cells += fmt::format("<td>{}</td>", cut.empty() ? "\u2013" : html_escape(cut));
  return cells;
}

std::string rows_of(const ReportInput& input, const PhaseRow& row, bool single) {
  const std::array<std::pair<const char*, double M::*>, 3> of{
      {{"phases.grains", row.grains}, {"phases.liquid", row.liquid}, {"phases.flow", row.flow}}};
  std::string html;
  for (const auto& [name, field] : of)
    if (field != nullptr)
      html +=
          fmt::format("<tr{}><th scope=\"row\">{}</th><td>{}</td>{}</tr>",
                      html.empty() ? " class=\"first\"" : "",
                      html.empty() ? html_escape(tr(fmt::format("phases.row.{}", row.key))) : "",
                      html_escape(tr(name)), cells_of(input, row, field, single));
  return html;
}

}  // namespace

std::string phases_html(const ReportInput& input) {
  const bool known =
      std::any_of(input.members.begin(), input.members.end(), [](const MemberSummary& m) {
        return is_valid(m.outcome) && !std::isnan(m.scalars.solid_runout_m);
      });
  if (!known) return {};
  const bool single = input.hazard == nullptr && input.members.size() == 1;
  std::string html =
      "<section id=\"phases\"><h2>" + html_escape(tr("phases.title")) +
      "</h2><div class=\"table-box short whole\" "
      "tabindex=\"0\"><table class=\"plain phases\"><thead><tr><th></th><th scope=\"col\">" +
      html_escape(tr("phases.of")) + "</th>";
  if (single) {
    html += "<th scope=\"col\" class=\"n\">" + html_escape(tr("phases.value")) + "</th>";
  } else {
    for (const double level : levels)
      html += fmt::format("<th scope=\"col\" class=\"n\">{}</th>",
                          level == 0.5 ? html_escape(tr("phases.median"))
                                       : fmt::format("{:g}\u00A0%", 100 * level));
    html += "<th scope=\"col\">" + html_escape(tr("phases.cut")) + "</th>";
  }
  html += "</tr></thead><tbody>";
  for (const PhaseRow& row : rows) html += rows_of(input, row, single);
  return html + "</tbody></table></div><p class=\"note\">" + html_escape(tr("phases.note")) +
         "</p></section>";
}

}  // namespace sturz
