// SPDX-License-Identifier: Apache-2.0
#include "reports/page/report.hpp"

#include "engine/core/error.hpp"
#include "reports/page/bundle.hpp"
#include "reports/page/page_head.hpp"
#include "reports/page/payload.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace sturz {
namespace {

std::string head_html(const ReportInput& input) {
  const std::string script = report_has_script() ? policy_hash(bundled_script_sha256()) + " " +
                                                       policy_hash(bundled_view3d_sha256())
                                                 : std::string("'none'");
  return page_head(input.title.empty() ? tr("page.title") : input.title + " \u2013 sturz", script);
}

/// Links to the parts that are there.
std::string navigation_html(const std::string& body) {
  static constexpr std::string_view parts[] = {"maps",        "numbers",  "sources",    "phases",
                                               "assets",      "observed", "posterior",  "motion",
                                               "gauges",      "spread",   "multilevel", "members",
                                               "computation", "origin",   "reading"};
  std::string html = "<nav aria-label=\"" + html_escape(tr("nav.label")) + "\">";
  for (const std::string_view id : parts)
    if (body.find(fmt::format("<section id=\"{}\"", id)) != std::string::npos)
      html += fmt::format("<a href=\"#{0}\"{1}>{2}</a>", id,
                          id == "spread" ? " class=\"needs-script\" hidden" : "",
                          html_escape(tr(fmt::format("nav.{}", id))));
  return html + "</nav>";
}

/// Drawing code of the 3-D view, packed: unpacked when a reader asks for it. Only over known
/// ground.
std::string view3d_html(const MapScene* scene) {
  const bool known =
      scene != nullptr && std::any_of(scene->ground.values.begin(), scene->ground.values.end(),
                                      [](double z) { return std::isfinite(z); });
  if (!known) return {};
  return "<script type=\"text/plain\" id=\"sturz-view3d\">" + std::string(bundled_view3d()) +
         "</script>\n";
}

}  // namespace

bool report_has_script() { return !bundled_script().empty(); }

ReportTable sampled_values(const DesignTable& design, std::span<const MemberSummary> members) {
  ReportTable table{design.keys, design.units, {}};
  for (const MemberSummary& m : members) {
    require(m.member >= 0 && m.member < design.n_members(),
            fmt::format("member {} is not in the design of {} members (the results belong to "
                        "another ensemble). Remove them or use their own design.",
                        m.member, design.n_members()));
    table.rows.push_back(design.values[static_cast<std::size_t>(m.member)]);
  }
  return table;
}

std::string make_report(const ReportInput& input) {
  const LanguageScope language(input.language);
  const Headline h = headline(input);
  const LayerStack* maps = input.hazard != nullptr ? input.hazard : input.peaks;
  std::optional<MapScene> scene;
  if (maps != nullptr && maps->grid.n_cells() > 0) scene = make_map_scene(*maps, input.elevation);
  const MapScene* shown = scene ? &*scene : nullptr;

  const std::string body =
      banner_html(input, h) + attention_html(input, h) + map_html(input, h, shown, maps) +
      "<div class=\"number-sheet\">" + headline_html(input, h) + warnings_html(input, h) +
      ranges_html(input) + "</div>" + "<div class=\"annex\"><h2 class=\"print-only\">" +
      html_escape(tr("sheet.annex")) + "</h2>" + sources_html(input) + phases_html(input) +
      assets_html(input) + observed_html(input, h) + posterior_html(input) + motion_html(input) +
      gauges_html(input) + charts_html(input, h) + members_html(input, h) +
      computation_html(input, h) + provenance_html(input) + reading_html(input) + "</div>";
  std::string page = head_html(input) + "<body>\n<main>\n" + header_html(input, h) +
                     navigation_html(body) + plain_words_html(input, h) + body + "\n</main>\n";
  if (report_has_script())
    page += "<script type=\"application/json\" id=\"sturz-data\">" +
            script_safe(report_payload(input, shown, maps)) + "</script>\n" + view3d_html(shown) +
            "<script>" + std::string(bundled_script()) + "</script>\n";
  return page + "</body>\n</html>\n";
}

}  // namespace sturz
