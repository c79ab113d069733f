// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/grain_states.hpp"
#include "engine/simulation/state_shares.hpp"
#include "reports/figures/motion_charts.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// "1.2 %": more digits than percent_text, since these shares are small and matter.
std::string share_text(double share) {
  if (std::isnan(share)) return "\u2013";
  const double percent = 100 * share;
  if (percent > 0 && percent < 0.01) return "<\u00A00.01\u00A0%";
  return shown_number(percent, percent < 10 ? 2 : 3) + "\u00A0%";
}

std::string legend_of(const MotionChart& chart) {
  std::string html = "<ul class=\"legend\">";
  const auto add = [&html](const MotionLine& line) {
    html += fmt::format(
        "<li><svg class=\"chip\" width=\"22\" height=\"12\" aria-hidden=\"true\"><rect "
        "class=\"area paint-{}\" width=\"22\" height=\"12\" rx=\"2\"/></svg>{}</li>",
        line.paint, html_escape(line.label));
  };
  // Areas lie on each other: the list begins with the uppermost.
  if (chart.stacked)
    std::for_each(chart.lines.rbegin(), chart.lines.rend(), add);
  else
    std::for_each(chart.lines.begin(), chart.lines.end(), add);
  return html + "</ul>";
}

std::string figure_html(const MotionChart& chart, const std::vector<double>& times) {
  return fmt::format(
      "<figure class=\"chart motion\"><figcaption>{0}<small id=\"read-{1}\"></small></figcaption>"
      "<div id=\"chart-{1}\" class=\"live-chart\" hidden></div>{2}{3}</figure>",
      html_escape(chart.title), chart.name, motion_chart_svg(chart, times), legend_of(chart));
}

std::string looser_text() { return tr("motion.looser", 1 + dilated_density_change); }

bool has_states(const MemberScalars& m) {
  return m.transition_fraction + m.dilute_fraction + m.ultradilute_fraction > 0;
}

/// One sentence on what the states were, or what a scene without them left out.
std::string states_text(const MemberScalars& m, const MemberHistory& history) {
  if (!history.has_states) {
    if (std::isnan(m.parted_fraction)) return tr("motion.no_states");
    return tr("motion.left_out", share_text(m.parted_fraction), looser_text());
  }
  const double loose = m.transition_fraction + m.dilute_fraction + m.ultradilute_fraction;
  std::string text =
      tr("motion.states", share_text(1 - loose), share_text(m.transition_fraction),
         share_text(m.dilute_fraction), share_text(m.ultradilute_fraction), leave_dense_fraction);
  if (history.has_temperature)
    return text + tr("motion.temperature", shown_number(m.max_granular_temperature_m2_s2),
                     share_text(m.granular_ratio));
  return text + tr("motion.no_dilute");
}

}  // namespace

std::string motion_html(const ReportInput& input) {
  if (input.history == nullptr || input.members.size() != 1) return {};
  const std::vector<MotionChart> charts = motion_charts(*input.history);
  if (charts.empty()) return {};
  const std::vector<double> times = motion_times(*input.history);
  std::string html = "<section id=\"motion\"><h2>" + html_escape(tr("motion.title")) +
                     "</h2><div class=\"charts motion\">";
  for (const MotionChart& chart : charts) html += figure_html(chart, times);
  return html + "</div><p class=\"note\">" + html_escape(tr("motion.note")) +
         html_escape(states_text(input.members.front().scalars, *input.history)) + "</p></section>";
}

std::string left_out_html(const std::vector<MemberSummary>& members) {
  std::vector<double> dilated;
  for (const MemberSummary& m : members)
    if (is_valid(m.outcome) && !has_states(m.scalars) && !std::isnan(m.scalars.parted_fraction))
      dilated.push_back(m.scalars.parted_fraction);
  if (dilated.empty()) return {};
  std::sort(dilated.begin(), dilated.end());
  return "<div><h3>" + html_escape(tr("motion.what_left_out")) + "</h3><p>" +
         html_escape(tr("motion.dilated", share_text(dilated[dilated.size() / 2]), looser_text(),
                        share_text(dilated.back()))) +
         "</p></div>";
}

}  // namespace sturz
