// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/scalar_censoring.hpp"
#include "reports/page/estimate_text.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"

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
  const char* label;
  const char* units;
  double M::*flow;  ///< null: not to be compared
  double M::*grains;
  double M::*liquid;
  bool percent = false;
};
constexpr std::array rows{
    PhaseRow{"Runout", "m", &M::runout_m, &M::solid_runout_m, &M::liquid_runout_m},
    PhaseRow{"Area reached", "m2", &M::reached_area_m2, &M::solid_reached_area_m2,
             &M::liquid_reached_area_m2},
    PhaseRow{"Largest thickness", "m", &M::max_thickness_m, &M::max_solid_thickness_m,
             &M::max_liquid_thickness_m},
    PhaseRow{"Largest speed of a cell", "m s-1", nullptr, &M::max_solid_speed_m_s,
             &M::max_liquid_speed_m_s},
    PhaseRow{"Largest kinetic energy", "J m-2", &M::max_energy_j_m2, &M::max_solid_energy_j_m2,
             &M::max_liquid_energy_j_m2},
    PhaseRow{"Largest dynamic pressure", "Pa", &M::max_pressure_pa, &M::max_solid_pressure_pa,
             &M::max_liquid_pressure_pa},
    PhaseRow{"Left the known terrain", "1", &M::lost_fraction, &M::solid_lost_fraction,
             &M::liquid_lost_fraction, true},
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
      {{"grains", row.grains}, {"liquid", row.liquid}, {"whole flow", row.flow}}};
  std::string html;
  for (const auto& [name, field] : of)
    if (field != nullptr)
      html += fmt::format("<tr{}><th scope=\"row\">{}</th><td>{}</td>{}</tr>",
                          html.empty() ? " class=\"first\"" : "", html.empty() ? row.label : "",
                          name, cells_of(input, row, field, single));
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
      "<section id=\"phases\"><h2>Grains and liquid</h2><div class=\"table-box short whole\" "
      "tabindex=\"0\"><table class=\"plain phases\"><thead><tr><th></th><th scope=\"col\">of</th>";
  if (single) {
    html += "<th scope=\"col\" class=\"n\">value</th>";
  } else {
    for (const double level : levels)
      html += fmt::format(
          "<th scope=\"col\" class=\"n\">{}</th>",
          level == 0.5 ? std::string("median") : fmt::format("{:g}\u00A0%", 100 * level));
    html += "<th scope=\"col\">cut off</th>";
  }
  html += "</tr></thead><tbody>";
  for (const PhaseRow& row : rows) html += rows_of(input, row, single);
  return html +
         "</tbody></table></div><p class=\"note\">Grains are cut off where grains left the known "
         "terrain, liquid where liquid did, the whole flow where either did, and all of them where "
         "the flow still moved at the end. Thickness of grains and of liquid is the volume of "
         "their own matter over area, without the pores. The dynamic pressure of each is its mass "
         "over the flow's volume times its own speed squared: its share of what the flow pushes "
         "with.</p></section>";
}

}  // namespace sturz
