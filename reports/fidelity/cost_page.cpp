// SPDX-License-Identifier: Apache-2.0
#include "reports/fidelity/cost_page.hpp"

#include "reports/fidelity/error_chart.hpp"
#include "reports/fidelity/result_words.hpp"
#include "reports/page/page_head.hpp"
#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sturz {
namespace {

constexpr std::array paints{"centre", "front", "rear", "transition"};

std::string share(double value) {
  if (!std::isfinite(value)) return "\u2013";
  return shown_number(100 * value, 2) + "\u00A0%";
}

std::string spacing_text(double spacing_m) { return shown_number(spacing_m, 3) + "\u00A0m"; }

ErrorLine line_of(const LadderAccuracy& ladder, std::size_t k) {
  ErrorLine line;
  line.label = words(ladder.formulation);
  line.paint = paints[k % paints.size()];
  line.seconds = ladder.member_cpu_s;
  for (const double d : ladder.spacings_m) line.notes.push_back(spacing_text(d));
  return line;
}

/// Lines of one result, of every formulation that tells it.
std::vector<ErrorLine> lines_of_result(const CostPage& page, const std::string& name) {
  std::vector<ErrorLine> lines;
  for (std::size_t k = 0; k < page.ladders.size(); ++k) {
    const LadderAccuracy& ladder = *page.ladders[k].ladder;
    for (const ResultAccuracy& r : ladder.results) {
      if (r.name != name) continue;
      lines.push_back(line_of(ladder, k));
      for (const double d : ladder.spacings_m) lines.back().errors.push_back(r.member_error(d));
    }
  }
  return lines;
}

std::vector<ErrorLine> lines_of_map(const CostPage& page) {
  std::vector<ErrorLine> lines;
  for (std::size_t k = 0; k < page.ladders.size(); ++k) {
    const LadderAccuracy& ladder = *page.ladders[k].ladder;
    if (ladder.maps.empty()) continue;
    lines.push_back(line_of(ladder, k));
    for (const double d : ladder.spacings_m)
      lines.back().errors.push_back(ladder.maps.front().errors.at(d));
  }
  return lines;
}

std::string legend_of(const std::vector<ErrorLine>& lines) {
  std::string html = "<ul class=\"legend\">";
  for (const ErrorLine& line : lines)
    html += fmt::format(
        "<li><svg class=\"chip\" width=\"22\" height=\"12\" aria-hidden=\"true\"><rect "
        "class=\"area paint-{}\" width=\"22\" height=\"12\" rx=\"2\"/></svg>{}</li>",
        line.paint, html_escape(line.label));
  return html + "</ul>";
}

struct Chart {
  std::string title;
  std::vector<ErrorLine> lines;
};

std::vector<Chart> charts_of(const CostPage& page) {
  std::vector<Chart> charts;
  std::vector<std::string> names;
  for (const CostPageLadder& l : page.ladders)
    for (const ResultAccuracy& r : l.ladder->results)
      if (std::find(names.begin(), names.end(), r.name) == names.end()) names.push_back(r.name);
  for (const std::string& name : names)
    charts.push_back({result_words(name), lines_of_result(page, name)});
  if (auto lines = lines_of_map(page); !lines.empty())
    charts.push_back(
        {fmt::format("map of thickness above {} m",
                     shown_number(page.ladders.front().ladder->maps.empty()
                                      ? nan_d
                                      : page.ladders.front().ladder->maps.front().threshold_m)),
         std::move(lines)});
  return charts;
}

std::string charts_html(const CostPage& page) {
  const std::vector<Chart> charts = charts_of(page);
  if (charts.empty()) return {};
  std::vector<ErrorLine> all;
  for (const Chart& chart : charts) all.insert(all.end(), chart.lines.begin(), chart.lines.end());
  const ErrorAxes axes = axes_for(all);
  std::string html =
      "<section id=\"charts\"><h2>Error against seconds</h2><div class=\"charts motion\">";
  for (const Chart& chart : charts)
    html += fmt::format("<figure class=\"chart\"><figcaption>{}</figcaption>{}{}</figure>",
                        html_escape(chart.title),
                        error_chart_svg(chart.title, chart.lines, axes, page.wanted_error),
                        legend_of(chart.lines));
  return html +
         fmt::format(
             "</div><p class=\"note\">Expected distance of one member from what it tends to, "
             "relative to the mean at the finest spacing; of maps the area between the "
             "map and what it tends to over the mean area. The dashed line is the wanted "
             "error, {}.</p></section>\n",
             share(page.wanted_error));
}

std::string table_of(const LadderAccuracy& ladder) {
  std::string html =
      "<div class=\"batch-box\"><table class=\"batch steps\"><thead><tr><th scope=\"col\">one "
      "member is "
      "off by</th>";
  for (const double d : ladder.spacings_m)
    html += fmt::format("<th scope=\"col\" class=\"n\">{}</th>", spacing_text(d));
  html +=
      "<th scope=\"col\" class=\"n\">order <small>90 % interval</small></th></tr></thead><tbody>";
  const auto row = [&](const std::string& name, const std::vector<std::string>& cells,
                       const std::string& last) {
    html += fmt::format("<tr><th scope=\"row\">{}</th>", html_escape(name));
    for (std::size_t i = 0; i < cells.size(); ++i)
      html += fmt::format("<td class=\"n\" data-label=\"{}\">{}</td>",
                          spacing_text(ladder.spacings_m[i]), cells[i]);
    html += fmt::format("<td class=\"n\" data-label=\"order\">{}</td></tr>", last);
  };
  std::vector<std::string> cells;
  for (const double s : ladder.member_cpu_s) cells.push_back(shown_number(s, 2) + "\u00A0s");
  row("computing time of a member", cells, shown_number(ladder.seconds.exponent, 2));
  for (const ResultAccuracy& r : ladder.results) {
    cells.clear();
    for (const double d : ladder.spacings_m) cells.push_back(share(r.member_error(d)));
    const Refinement& f = r.refinement;
    row(result_words(r.name), cells,
        !f.converges ? std::string("none")
        : std::isfinite(f.order_90.low)
            ? fmt::format("{} <small>{} \u2013 {}</small>", shown_number(f.order),
                          shown_number(f.order_90.low), shown_number(f.order_90.high))
            : shown_number(f.order));
  }
  for (const MapAccuracy& map : ladder.maps) {
    cells.clear();
    for (const double d : ladder.spacings_m) cells.push_back(share(map.errors.at(d)));
    row(fmt::format("map above {} m", shown_number(map.threshold_m)), cells, "");
  }
  return html + "</tbody></table></div>";
}

std::string parts_of(const CostPageLadder& l, const std::string& planned) {
  std::string html = fmt::format(
      "<h3>The mean of {} at {}</h3><div class=\"batch-box\"><table class=\"batch "
      "steps\">"
      "<thead><tr><th scope=\"col\">off by about</th><th scope=\"col\" class=\"n\">sampling, 90 "
      "%</th>"
      "<th scope=\"col\" class=\"n\">resolution</th><th scope=\"col\" class=\"n\">model</th></tr>"
      "</thead><tbody>",
      html_escape(planned), spacing_text(l.ladder->spacings_m.back()));
  for (const CostPageParts& p : l.parts)
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"n\" data-label=\"sampling\">{}</td><td "
        "class=\"n\" data-label=\"resolution\">{}</td><td class=\"n\" data-label=\"model\">{}</td>"
        "</tr>",
        html_escape(result_words(p.result)), share(p.sampling), share(p.resolution),
        share(p.model));
  html += "</tbody></table></div>";
  if (std::none_of(l.parts.begin(), l.parts.end(),
                   [](const CostPageParts& p) { return std::isfinite(p.model); }))
    html +=
        "<p class=\"note\">Model is not known: no other formulation was computed "
        "(<code>--formulations</code>).</p>";
  return html;
}

/// What was said of a finer spacing that no estimate knew.
std::string checked_of(const LadderAccuracy& ladder) {
  if (ladder.checked.empty()) return {};
  std::string html = fmt::format(
      "<h3>Checked by members at {}</h3><div class=\"batch-box\"><table class=\"batch steps\">"
      "<thead><tr><th scope=\"col\">difference to {} of</th><th scope=\"col\" class=\"n\">spacing"
      "</th><th scope=\"col\" class=\"n\">said</th><th scope=\"col\" class=\"n\">found</th><th "
      "scope=\"col\" class=\"n\">factor</th><th scope=\"col\" class=\"n\">to a factor of "
      "2</th></tr>"
      "</thead><tbody>",
      spacing_text(ladder.held_out_m), spacing_text(ladder.held_out_m));
  for (const CheckedError& c : ladder.checked)
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"n\" data-label=\"spacing\">{}</td><td "
        "class=\"n\" "
        "data-label=\"said\">{}</td><td class=\"n\" data-label=\"found\">{}</td><td class=\"n\" "
        "data-label=\"factor\">{}</td><td class=\"n\" data-label=\"to a factor of 2\">{}</td></tr>",
        html_escape(std::isfinite(c.threshold_m)
                        ? fmt::format("map above {} m", shown_number(c.threshold_m))
                        : result_words(c.name)),
        spacing_text(c.spacing_m), share(c.said), share(c.found),
        c.is_told() ? shown_number(c.factor(), 2) : share(nan_d),
        !c.is_told() ? share(nan_d)
        : c.is_met() ? "yes"
                     : "no");
  return html + "</tbody></table></div>";
}

/// The answer, before the charts that it was read from.
std::string answers_html(const CostPage& page) {
  std::string html = "<section id=\"answer\"><h2>In short</h2>";
  for (const CostPageLadder& l : page.ladders) {
    if (l.sentences.empty()) continue;
    if (page.ladders.size() > 1)
      html += fmt::format("<h3>{}</h3>", html_escape(words(l.ladder->formulation)));
    html += "<ul>";
    for (const std::string& sentence : l.sentences)
      html += "<li>" + html_escape(sentence) + "</li>";
    html += "</ul>";
  }
  return html + "</section>\n";
}

std::string ladders_html(const CostPage& page) {
  std::string html;
  for (const CostPageLadder& l : page.ladders) {
    html += fmt::format(
        "<section><h2>{}</h2><p class=\"note\">{} of {} members, drawn alike at "
        "every spacing.</p>",
        html_escape(words(l.ladder->formulation)), l.ladder->members.size(), l.ladder->n_asked);
    html += table_of(*l.ladder);
    if (!l.parts.empty()) html += parts_of(l, page.planned);
    html += checked_of(*l.ladder);
    html += "</section>\n";
  }
  return html;
}

std::string multilevel_html(const CostPage& page) {
  if (page.multilevel.empty()) return {};
  std::string html = "<section><h2>Few dear members and many cheap ones</h2>";
  for (const std::string& sentence : page.multilevel)
    html += "<p>" + html_escape(sentence) + "</p>\n";
  return html + "</section>\n";
}

std::string changes_html(const CostPage& page) {
  std::string html;
  for (const CostPageChange& change : page.changes) {
    html += fmt::format(
        "<section><h2>{}</h2><div class=\"batch-box\"><table class=\"batch steps\"><thead><tr><th "
        "scope=\"col\">change of</th><th scope=\"col\" class=\"n\">by</th><th scope=\"col\" "
        "class=\"n\">standard error</th><th scope=\"col\" class=\"n\">pairs</th></tr></thead>"
        "<tbody>",
        html_escape(change.title));
    for (const Change& c : change.changes)
      html += fmt::format(
          "<tr><th scope=\"row\">{}</th><td class=\"n\" data-label=\"by\">{} <small>{}</small></td>"
          "<td class=\"n\" data-label=\"standard error\">{}</td><td class=\"n\" "
          "data-label=\"pairs\">{}</td></tr>",
          html_escape(result_words(c.name)), html_escape(with_unit(c.mean, c.units)),
          share(c.mean / std::abs(c.rung_mean)), html_escape(with_unit(c.standard_error, c.units)),
          c.n_members);
    html += "</tbody></table></div></section>\n";
  }
  return html;
}

std::string warnings_html(const CostPage& page) {
  if (page.warnings.empty()) return {};
  std::string html = "<div class=\"warnings\"><h2>Warnings of the scenes</h2><ul>";
  for (const std::string& warning : page.warnings) html += "<li>" + html_escape(warning) + "</li>";
  return html + "</ul></div>\n";
}

const char* const reading_html =
    "<section id=\"reading\"><h2>How to read this</h2><p class=\"note\">Errors are "
    "estimates from the differences of the same members between spacings: a law of the spacing "
    "that all follow (Richardson's extrapolation) and what scatters about it, with the first order "
    "of a front as prior. They are root mean squares: one member of three is off by more. Sampling "
    "is the half width of the 90 % bounds of the mean of independent members; resolution the "
    "expected size of what that mean is off by at the finest spacing; model how far another "
    "formulation lies away "
    "with the same values, which no member and no spacing removes. The same numbers and more stand "
    "in cost.json and cost.csv.</p></section>\n";

}  // namespace

std::string make_cost_page(const CostPage& page) {
  return page_head(page.title + " \u2013 what accuracy costs", "'none'") + "<body>\n<main>\n" +
         fmt::format(
             "<header class=\"top\"><p class=\"kind\">What accuracy costs</p><h1>{}</h1><p "
             "class=\"origin\">{} \u00B7 {}</p></header>\n",
             html_escape(page.title), html_escape(page.when), html_escape(page.program)) +
         answers_html(page) + warnings_html(page) + charts_html(page) + ladders_html(page) +
         changes_html(page) + multilevel_html(page) + reading_html + "</main>\n</body>\n</html>\n";
}

}  // namespace sturz
