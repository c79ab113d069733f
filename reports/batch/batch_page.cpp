// SPDX-License-Identifier: Apache-2.0
#include "reports/batch/batch_page.hpp"

#include "reports/page/page_head.hpp"
#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

const std::string dash = "\u2013";

std::string card(const std::string& label, const std::string& value, const std::string& detail) {
  return fmt::format(
      "<div class=\"card\"><dt>{}</dt><dd class=\"value\">{}</dd><dd "
      "class=\"detail\">{}</dd></div>",
      html_escape(label), html_escape(value), html_escape(detail));
}

std::int64_t count(const BatchPage& page, const char* state) {
  return std::count_if(page.rows.begin(), page.rows.end(),
                       [state](const BatchPageRow& row) { return row.state == state; });
}

std::string cards_html(const BatchPage& page) {
  const std::int64_t failed = count(page, "failed");
  const std::int64_t open = count(page, "interrupted") + count(page, "waiting");
  std::string html = "<section><dl class=\"cards\">";
  html += card("Jobs", std::to_string(page.rows.size()), "in " + page.list);
  html += card("Computed", std::to_string(count(page, "computed")), "by this call");
  html += card("Unchanged", std::to_string(count(page, "unchanged")), "results of before hold");
  html += card("Failed", std::to_string(failed), failed > 0 ? "reasons below" : "none");
  html += card("To come", std::to_string(open), open > 0 ? "the same command goes on" : "none");
  html += card("Computing time", duration_text(page.core_s),
               fmt::format("of {} core{} in {}", page.cores, page.cores == 1 ? "" : "s",
                           duration_text(page.wall_s)));
  html += card("Utilisation", std::isnan(page.utilisation) ? dash : percent_text(page.utilisation),
               page.low_utilisation.empty() ? "of the cores, this call" : page.low_utilisation);
  return html + "</dl></section>\n";
}

std::string failures_html(const BatchPage& page) {
  std::string items;
  for (const BatchPageRow& row : page.rows)
    if (row.state == "failed")
      items += fmt::format("<li><strong>{}</strong>: {}</li>", html_escape(row.job),
                           html_escape(row.message));
  std::string html;
  if (!page.stop.empty())
    html += fmt::format(
        "<div class=\"warnings\"><h2>Ended early</h2><p>{}. The same command goes "
        "on.</p></div>\n",
        html_escape(page.stop));
  if (!items.empty())
    html += "<div class=\"banner\"><h2>Failed jobs</h2><ul class=\"lost-list\">" + items +
            "</ul></div>\n";
  return html;
}

/// A cell that tells its column's name where the table is shown as cards.
std::string cell(const char* label, const std::string& html, bool number = false) {
  return fmt::format("<td data-label=\"{}\"{}>{}</td>", label, number ? " class=\"n\"" : "",
                     html.empty() ? dash : html);
}

std::string members_text(const BatchPageRow& row) {
  if (row.valid < 0) return {};
  if (row.single_run) return row.valid == 1 ? "single run" : "failed run";
  std::string text = row.valid == row.planned ? fmt::format("{}", row.valid)
                                              : fmt::format("{} of {}", row.valid, row.planned);
  if (row.finished > row.valid) text += fmt::format(", {} failed", row.finished - row.valid);
  if (row.censored > 0) text += fmt::format(", {} cut off", row.censored);
  return text;
}

std::string at_least(bool is, double value) {
  return (is ? "\u2265\u00A0" : "") + shown_number(value);
}

std::string runout_text(const BatchPageRow& row) {
  if (std::isnan(row.runout_m[1])) return {};
  std::string text = at_least(row.at_least[1], row.runout_m[1]) + " m";
  if (!row.single_run)
    text += fmt::format(" <small>{} \u2013 {}</small>", at_least(row.at_least[0], row.runout_m[0]),
                        at_least(row.at_least[2], row.runout_m[2]));
  return text;
}

std::string area_html(double area_m2) {
  return std::isnan(area_m2) ? std::string() : html_escape(area_text(area_m2));
}

std::string asset_html(const BatchPageRow& row) {
  if (row.n_assets == 0) return {};
  if (row.asset.empty()) return fmt::format("none of {} hit", row.n_assets);
  return fmt::format("{} <small>{}</small>", html_escape(percent_text(row.asset_probability)),
                     html_escape(row.asset));
}

std::string row_html(const BatchPageRow& row) {
  const std::string name = html_escape(row.job);
  const std::string title = row.title.empty() || row.title == row.job
                                ? ""
                                : "<small>" + html_escape(row.title) + "</small>";
  std::string html = fmt::format(
      "<tr><th scope=\"row\">{}{}</th>",
      row.link.empty() ? name : fmt::format("<a href=\"{}\">{}</a>", html_escape(row.link), name),
      title);
  html += fmt::format("<td data-label=\"state\"><span class=\"state {0}\">{0}</span></td>",
                      html_escape(row.state));
  html += cell("why", html_escape(row.why));
  html += cell("members", html_escape(members_text(row)), true);
  html += cell("runout", runout_text(row), true);
  html += cell("area, P \u2265 0.5", area_html(row.area_half_m2), true);
  html += cell("area, any", area_html(row.area_any_m2), true);
  html += cell("asset", asset_html(row), true);
  html +=
      cell("computing",
           std::isnan(row.core_s) ? std::string() : html_escape(duration_text(row.core_s)), true);
  html +=
      cell("utilisation",
           std::isnan(row.utilisation) ? std::string() : html_escape(percent_text(row.utilisation)),
           true);
  return html + "</tr>\n";
}

std::string table_html(const BatchPage& page) {
  std::string html =
      "<section id=\"jobs\"><h2>Jobs</h2><div class=\"batch-box\"><table class=\"batch\"><thead>"
      "<tr><th scope=\"col\">job</th><th scope=\"col\">state</th><th scope=\"col\">why it was "
      "computed</th><th scope=\"col\" class=\"n\">valid members</th><th scope=\"col\" "
      "class=\"n\">runout <small>median, 5 \u2013 95 %</small></th><th scope=\"col\" "
      "class=\"n\">area <small>P \u2265 0.5</small></th><th scope=\"col\" class=\"n\">area "
      "<small>any member</small></th><th scope=\"col\" class=\"n\">asset <small>most "
      "probable</small></th><th scope=\"col\" class=\"n\">computing <small>all members</small>"
      "</th><th scope=\"col\" class=\"n\">utilisation</th></tr></thead>\n<tbody>\n";
  for (const BatchPageRow& row : page.rows) html += row_html(row);
  return html + "</tbody></table></div></section>\n";
}

const char* const reading_html =
    "<section id=\"reading\"><h2>How to read this</h2><p class=\"note\">Each name leads to the "
    "page of that job's results. Areas are those of cells that at least half of the valid members "
    "reach, and that any of them reaches. \u2265 marks what is only known from below, because "
    "members left the known ground or still moved at their end. Utilisation is computing time over "
    "elapsed time and cores, of the call that computed the members. The same numbers stand in "
    "summary.csv, the outlines in outlines.gpkg.</p></section>\n";

}  // namespace

std::string make_batch_page(const BatchPage& page) {
  return page_head(page.list + " \u2013 sturz batch", "'none'") + "<body>\n<main>\n" +
         fmt::format(
             "<header class=\"top\"><p class=\"kind\">Batch</p><h1>{}</h1><p "
             "class=\"origin\">{} \u00B7 {}</p></header>\n",
             html_escape(page.list), html_escape(page.when), html_escape(page.program)) +
         failures_html(page) + cards_html(page) + table_html(page) + reading_html +
         "</main>\n</body>\n</html>\n";
}

}  // namespace sturz
