// SPDX-License-Identifier: Apache-2.0
// What each asset has to expect.
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

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
  const auto column = [](const char* key, const std::string& unit) {
    return head_cell(tr(fmt::format("assets.col.{}", key)), unit);
  };
  std::string head = column("asset", "");
  if (assets.has_classes) head += column("class", "");
  head += column("hit", "") + column("thickness", "m") + column("speed", "m/s") +
          column("pressure", "kPa") + column("arrival", "s");
  if (assets.has_classes) head += column("damage", "");
  if (assets.has_classes && assets.has_values) head += column("loss", assets.value_unit);
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
           fmt::format("<td colspan=\"{}\">{}</td></tr>", rest, html_escape(tr("assets.beyond")));
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
      risk.n_without_loss == 0 ? "" : tr("assets.without", risk.n_without_loss, risk.rows.size());
  return "<p>" +
         html_escape(tr("assets.total", at_least(more, shown_number(risk.total_loss.mean)),
                        std::isnan(error) ? "" : " \u00B1 " + shown_number(error, 2),
                        assets.value_unit, out)) +
         "</p>";
}

}  // namespace

std::string assets_html(const ReportInput& input) {
  if (input.assets == nullptr || input.risk == nullptr || input.assets->list.empty()) return {};
  const Assets& assets = *input.assets;
  std::string html =
      "<section id=\"assets\"><h2>" + html_escape(tr("assets.title")) + "</h2>" +
      total_text(assets, *input.risk) +
      "<div class=\"table-box short\" tabindex=\"0\"><table class=\"spaced\"><thead><tr>" +
      head_of(assets) + "</tr></thead><tbody>";
  const std::vector<std::size_t> order = order_of(*input.risk);
  for (std::size_t k = 0; k < std::min(most_rows, order.size()); ++k)
    html += row_of(assets, assets.list[order[k]], input.risk->rows[order[k]]);
  html += "</tbody></table></div><p class=\"note\">" + html_escape(tr("assets.note"));
  if (assets.has_classes) html += html_escape(tr("assets.note_damage"));
  html += html_escape(tr("assets.note_end"));
  if (order.size() > most_rows) html += html_escape(tr("table.first_of", most_rows, order.size()));
  return html + "</p></section>";
}

}  // namespace sturz
