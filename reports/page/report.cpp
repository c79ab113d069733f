// SPDX-License-Identifier: Apache-2.0
#include "reports/page/report.hpp"

#include "engine/core/error.hpp"
#include "reports/page/bundle.hpp"
#include "reports/page/page_head.hpp"
#include "reports/page/payload.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <optional>

namespace sturz {
namespace {

std::string head_html(const ReportInput& input) {
  const std::string script =
      report_has_script() ? policy_hash(bundled_script_sha256()) : std::string("'none'");
  return page_head(input.title.empty() ? "sturz report" : input.title + " \u2013 sturz", script);
}

/// Links to the parts that are there.
std::string navigation_html(const std::string& body) {
  static constexpr std::pair<const char*, const char*> parts[] = {
      {"maps", "Maps"},       {"sources", "Sources"},         {"phases", "Grains and liquid"},
      {"assets", "Assets"},   {"observed", "Observed"},       {"posterior", "Calibration"},
      {"motion", "Motion"},   {"gauges", "Gauges"},           {"spread", "Spread"},
      {"members", "Members"}, {"computation", "Computation"}, {"origin", "Origin"},
      {"reading", "Reading"}};
  std::string html = "<nav aria-label=\"Parts of this page\">";
  for (const auto& [id, label] : parts)
    if (body.find(fmt::format("<section id=\"{}\"", id)) != std::string::npos)
      html += fmt::format("<a href=\"#{0}\"{1}>{2}</a>", id,
                          std::string_view(id) == "spread" ? " class=\"needs-script\" hidden" : "",
                          label);
  return html + "</nav>";
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
  const Headline h = headline(input);
  const LayerStack* maps = input.hazard != nullptr ? input.hazard : input.peaks;
  std::optional<MapScene> scene;
  if (maps != nullptr && maps->grid.n_cells() > 0) scene = make_map_scene(*maps, input.elevation);
  const MapScene* shown = scene ? &*scene : nullptr;

  const std::string body =
      banner_html(input, h) + warnings_html(input, h) + headline_html(input, h) +
      map_html(input, shown, maps) + sources_html(input) + phases_html(input) + assets_html(input) +
      observed_html(input, h) + posterior_html(input) + motion_html(input) + gauges_html(input) +
      charts_html(input, h) + members_html(input, h) + computation_html(input, h) +
      provenance_html(input) + reading_html(input);
  std::string page = head_html(input) + "<body>\n<main>\n" + header_html(input, h) +
                     navigation_html(body) + body + "\n</main>\n";
  if (report_has_script())
    page += "<script type=\"application/json\" id=\"sturz-data\">" +
            script_safe(report_payload(input, shown, maps)) + "</script>\n<script>" +
            std::string(bundled_script()) + "</script>\n";
  return page + "</body>\n</html>\n";
}

}  // namespace sturz
