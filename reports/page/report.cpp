// SPDX-License-Identifier: Apache-2.0
#include "reports/page/report.hpp"

#include "engine/core/error.hpp"
#include "reports/figures/codec.hpp"
#include "reports/page/bundle.hpp"
#include "reports/page/payload.hpp"
#include "reports/page/sections.hpp"
#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

namespace sturz {
namespace {

/// 'sha256-<base64>' as a Content-Security-Policy wants it.
std::string policy_hash(std::string_view hex) {
  std::vector<std::uint8_t> bytes(hex.size() / 2);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    std::from_chars(hex.data() + 2 * i, hex.data() + 2 * i + 2, bytes[i], 16);
  return "'sha256-" + base64(bytes) + "'";
}

std::string head_html(const ReportInput& input) {
  const std::string script =
      report_has_script() ? policy_hash(bundled_script_sha256()) : std::string("'none'");
  return fmt::format(
             "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
             "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
             "script-src {}; style-src {}; img-src data: blob:\">\n"
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
             "<meta name=\"color-scheme\" content=\"light dark\">\n"
             "<meta name=\"generator\" content=\"sturz\">\n<title>{}</title>\n<style>",
             script, policy_hash(bundled_style_sha256()),
             html_escape(input.title.empty() ? "sturz report" : input.title + " \u2013 sturz")) +
         std::string(bundled_style()) + "</style>\n</head>\n";
}

/// Links to the parts that are there.
std::string navigation_html(const std::string& body) {
  static constexpr std::pair<const char*, const char*> parts[] = {{"maps", "Maps"},
                                                                  {"phases", "Grains and liquid"},
                                                                  {"assets", "Assets"},
                                                                  {"observed", "Observed"},
                                                                  {"posterior", "Calibration"},
                                                                  {"motion", "Motion"},
                                                                  {"gauges", "Gauges"},
                                                                  {"spread", "Spread"},
                                                                  {"members", "Members"},
                                                                  {"computation", "Computation"},
                                                                  {"origin", "Origin"},
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
      map_html(input, shown, maps) + phases_html(input) + assets_html(input) +
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
