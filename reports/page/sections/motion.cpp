// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/grain_states.hpp"
#include "engine/simulation/state_shares.hpp"
#include "reports/figures/motion_charts.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"

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

std::string looser_text() {
  return fmt::format("looser than {} of its packing at release", 1 + dilated_density_change);
}

bool has_states(const MemberScalars& m) {
  return m.transition_fraction + m.dilute_fraction + m.ultradilute_fraction > 0;
}

/// One sentence on what the states were, or what a scene without them left out.
std::string states_text(const MemberScalars& m, const MemberHistory& history) {
  if (!history.has_states) {
    if (std::isnan(m.parted_fraction))
      return "Columns (depth_averaged) have no states, nor has a liquid by itself: how loose the "
             "grains were is not known.";
    return fmt::format(
        "At most {} of the mass and time was {}; what such grains do beyond falling freely was "
        "left out, since grains.states was not asked for.",
        share_text(m.parted_fraction), looser_text());
  }
  const double loose = m.transition_fraction + m.dilute_fraction + m.ultradilute_fraction;
  std::string text = fmt::format(
      "Of mass and time {} were dense, {} in transition, {} dilute, {} ultradilute. A dense grain "
      "counts as dense down to a solid fraction of {:.2f}; particles that lie by themselves have "
      "few neighbours and count as dilute or ultradilute at rest too.",
      share_text(1 - loose), share_text(m.transition_fraction), share_text(m.dilute_fraction),
      share_text(m.ultradilute_fraction), leave_dense_fraction);
  if (history.has_temperature)
    return text + fmt::format(
                      " The largest granular temperature was {} m\u00B2/s\u00B2, {} of the "
                      "largest speed squared.",
                      shown_number(m.max_granular_temperature_m2_s2), share_text(m.granular_ratio));
  return text +
         " Collisions of dilute grains were left out, since grains.states.dilute was not "
         "asked for.";
}

}  // namespace

std::string motion_html(const ReportInput& input) {
  if (input.history == nullptr || input.members.size() != 1) return {};
  const std::vector<MotionChart> charts = motion_charts(*input.history);
  if (charts.empty()) return {};
  const std::vector<double> times = motion_times(*input.history);
  std::string html =
      "<section id=\"motion\"><h2>Motion over time</h2><div class=\"charts motion\">";
  for (const MotionChart& chart : charts) html += figure_html(chart, times);
  return html +
         "</div><p class=\"note\">Travel is the horizontal displacement of each particle from "
         "where "
         "it started, of the mass still on the terrain. " +
         html_escape(states_text(input.members.front().scalars, *input.history)) + "</p></section>";
}

std::string left_out_html(const std::vector<MemberSummary>& members) {
  std::vector<double> dilated;
  for (const MemberSummary& m : members)
    if (is_valid(m.outcome) && !has_states(m.scalars) && !std::isnan(m.scalars.parted_fraction))
      dilated.push_back(m.scalars.parted_fraction);
  if (dilated.empty()) return {};
  std::sort(dilated.begin(), dilated.end());
  return fmt::format(
      "<div><h3>What was left out</h3><p>Grains that separate and meet again: at most {} of the "
      "mass "
      "and time was {} in the median member, {} in the worst. Where that is much, ask for "
      "grains.states.</p></div>",
      share_text(dilated[dilated.size() / 2]), looser_text(), share_text(dilated.back()));
}

}  // namespace sturz
