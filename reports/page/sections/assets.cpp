// SPDX-License-Identifier: Apache-2.0
// What each asset has to expect.
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace sturz {
namespace {

constexpr std::size_t most_rows = 200;

/// Most probable first; of equal ones in the order of the file. Unknown ones last.
std::vector<std::size_t> order_of(const RiskTable& risk) {
  std::vector<std::size_t> order(risk.rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) {
    const double p = risk.rows[i].probability;
    return std::isnan(p) ? -1 : p;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) > rank(b); });
  return order;
}

std::string head_cell(const std::string& label, const std::string& unit) {
  return fmt::format("<th scope=\"col\">{}{}</th>", html_escape(label),
                     unit.empty() ? "" : "<small>" + html_escape(unit) + "</small>");
}

std::string head_of(const Assets& assets) {
  std::string head = head_cell("asset", "");
  if (assets.has_classes) head += head_cell("class", "");
  head += head_cell("hit (95 % interval)", "") + head_cell("thickness", "m") +
          head_cell("speed", "m/s") + head_cell("pressure", "kPa") + head_cell("arrival", "s");
  if (assets.has_classes) head += head_cell("expected damage", "");
  if (assets.has_classes && assets.has_values)
    head += head_cell("expected loss", assets.value_unit);
  return head;
}

std::string number_cell(const std::string& text) { return "<td class=\"n\">" + text + "</td>"; }

/// "\u2265 " in front of what can only become more.
std::string at_least(bool is, const std::string& text) { return is ? "\u2265\u00A0" + text : text; }

std::string quantile_cell(const HitQuantiles& q, bool lower_bound) {
  if (std::isnan(q[1])) return number_cell("\u2013");
  return number_cell(at_least(lower_bound, shown_number(q[1])) +
                     fmt::format(" ({} \u2013 {})", shown_number(q[0]), shown_number(q[2])));
}

std::string expected_cell(const ExpectedValue& e, bool lower_bound) {
  if (std::isnan(e.mean)) return number_cell("\u2013");
  const std::string error =
      std::isnan(e.standard_error) ? "" : " \u00B1 " + shown_number(e.standard_error, 2);
  return number_cell(at_least(lower_bound, shown_number(e.mean)) + error);
}

std::string row_of(const Assets& assets, const Asset& asset, const AssetRisk& r) {
  std::string row = fmt::format("<tr{}><th scope=\"row\">{}</th>",
                                r.cut_off.empty() ? "" : " class=\"cut\"", html_escape(asset.name));
  if (assets.has_classes) row += "<td>" + html_escape(asset.vulnerability_class) + "</td>";
  if (r.place == AssetPlace::outside) {
    const int rest =
        5 + (assets.has_classes ? 1 : 0) + (assets.has_classes && assets.has_values ? 1 : 0);
    return row +
           fmt::format("<td colspan=\"{}\">beyond the known ground: nothing is known</td></tr>",
                       rest);
  }
  const std::string share =
      std::isnan(r.probability)
          ? "\u2013"
          : at_least(r.not_known > 0, html_escape(percent_text(r.probability))) +
                fmt::format(" ({} \u2013 {})", html_escape(percent_text(r.bounds_95.lower)),
                            html_escape(percent_text(r.bounds_95.upper)));
  const bool grows = r.hit_cut_off > 0, more = r.hit_cut_off + r.not_known > 0;
  row += number_cell(share) + quantile_cell(r.thickness_m, grows) +
         quantile_cell(r.speed_m_s, grows) + quantile_cell(r.pressure_kpa, grows) +
         quantile_cell(r.arrival_s, false);
  if (assets.has_classes) row += expected_cell(r.damage, more);
  if (assets.has_classes && assets.has_values) row += expected_cell(r.loss, more);
  return row + "</tr>";
}

std::string total_text(const Assets& assets, const RiskTable& risk) {
  if (std::isnan(risk.total_loss.mean)) return {};
  const bool more = std::any_of(risk.rows.begin(), risk.rows.end(), [](const AssetRisk& r) {
    return r.not_known + r.hit_cut_off > 0 || r.place != AssetPlace::inside;
  });
  const double error = risk.total_loss.standard_error;
  const std::string out =
      risk.n_without_loss == 0
          ? ""
          : fmt::format(" That is without {} of {} assets, whose loss is not known.",
                        risk.n_without_loss, risk.rows.size());
  return fmt::format("<p>Expected loss of all assets together, by one event: {}{} {}.{}</p>",
                     at_least(more, shown_number(risk.total_loss.mean)),
                     std::isnan(error) ? "" : " \u00B1 " + shown_number(error, 2),
                     html_escape(assets.value_unit), out);
}

}  // namespace

std::string assets_html(const ReportInput& input) {
  if (input.assets == nullptr || input.risk == nullptr || input.assets->list.empty()) return {};
  const Assets& assets = *input.assets;
  std::string html =
      "<section id=\"assets\"><h2>Assets</h2>" + total_text(assets, *input.risk) +
      "<div class=\"table-box short\" tabindex=\"0\"><table class=\"spaced\"><thead><tr>" +
      head_of(assets) + "</tr></thead><tbody>";
  const std::vector<std::size_t> order = order_of(*input.risk);
  for (std::size_t k = 0; k < std::min(most_rows, order.size()); ++k)
    html += row_of(assets, assets.list[order[k]], input.risk->rows[order[k]]);
  html +=
      "</tbody></table></div><p class=\"note\">Hit: a member reached a cell that the asset "
      "touches; the share of the valid members. Thickness, speed and pressure: the largest "
      "over those cells, median (5 \u2013 95 %) among the members that hit; arrival: the "
      "earliest. ";
  if (assets.has_classes)
    html +=
        "Expected damage: share of the value, over all valid members, \u00B1 its standard "
        "error. ";
  html +=
      "All by one event, not by year. \u201C\u2265\u201D: members that were cut off make it a "
      "lower bound. All assets are in assets.csv and assets.gpkg.";
  if (order.size() > most_rows)
    html += fmt::format(" Here are the first {} of {}.", most_rows, order.size());
  return html + "</p></section>";
}

}  // namespace sturz
