// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/motion_charts.hpp"

#include "engine/laws/grain_states.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace sturz {
namespace {

std::vector<double> column(const MemberHistory& history, float HistoryRow::*field) {
  std::vector<double> values;
  for (const HistoryRow& row : history.rows) values.push_back(row.*field);
  return values;
}

double largest(const MotionChart& chart) {
  double most = 0;
  for (const MotionLine& line : chart.lines)
    for (const double v : line.values) most = std::max(most, v);
  return most;
}

/// Smallest step times a power of ten that is not below `value` > 0.
double round_up(double value, std::span<const double> steps) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : steps)
    if (step * power >= value * (1 - 1e-12)) return step * power;
  return 10 * power;
}

/// Between ticks.
double round_step(double least) { return round_up(least, std::array{1.0, 2.0, 2.5, 5.0}); }

MotionChart travel(const MemberHistory& h) {
  MotionChart chart{.name = "travel", .title = tr("chart.travel"), .unit = "m", .lines = {}};
  chart.lines = {{tr("chart.travel.front"), "front", column(h, &HistoryRow::front_travel_m)},
                 {tr("chart.travel.centre"), "centre", column(h, &HistoryRow::com_travel_m)},
                 {tr("chart.travel.rear"), "rear", column(h, &HistoryRow::tail_travel_m)}};
  chart.top = round_top(largest(chart));
  return chart;
}

MotionChart speed(const MemberHistory& h) {
  MotionChart chart{.name = "speed", .title = tr("chart.speed"), .unit = "m/s", .lines = {}};
  chart.lines = {{tr("chart.speed.fastest"), "fastest", column(h, &HistoryRow::max_speed_m_s)},
                 {tr("chart.speed.front"), "front", column(h, &HistoryRow::front_speed_m_s)},
                 {tr("chart.speed.mean"), "centre", column(h, &HistoryRow::mean_speed_m_s)},
                 {tr("chart.speed.rear"), "rear", column(h, &HistoryRow::tail_speed_m_s)}};
  chart.top = round_top(largest(chart));
  return chart;
}

std::string fraction_text(double value) { return fmt::format("{:.2f}", value); }

/// Loosest at the bottom; where little is loose the axis ends above it, and dense is the rest.
MotionChart states(const MemberHistory& h) {
  MotionChart chart{
      .name = "states", .title = tr("chart.states"), .unit = "%", .stacked = true, .lines = {}};
  const std::string d = fraction_text(dense_fraction), t = fraction_text(transition_fraction),
                    u = fraction_text(ultradilute_fraction);
  chart.lines = {{tr("chart.states.ultradilute", u), "ultradilute", {}},
                 {tr("chart.states.dilute", u, t), "dilute", {}},
                 {tr("chart.states.transition", t, d), "transition", {}},
                 {tr("chart.states.dense", d), "dense", {}}};
  double loose = 0;
  for (const HistoryRow& row : h.rows) {
    double sum = 0;
    const float shares[] = {row.ultradilute, row.dilute, row.transition, row.dense};
    for (std::size_t k = 0; k < chart.lines.size(); ++k) {
      sum += 100 * shares[k];
      chart.lines[k].values.push_back(sum);
    }
    loose = std::max(loose, chart.lines[2].values.back());
  }
  chart.top = std::min(100.0, round_top(std::max(4.0, 1.15 * loose)));
  if (chart.top < 100) chart.lines[3].label += tr("chart.the_rest");
  return chart;
}

constexpr double width = 420, height = 240, left = 44, right = 8, top = 10, bottom = 34;

/// Where numbers fall in the still picture.
struct Axes {
  double end, most;
  double x(double t) const { return left + (width - left - right) * t / end; }
  double y(double v) const {
    return height - bottom - (height - top - bottom) * std::clamp(v / most, 0.0, 1.0);
  }
};

std::string grid_svg(const Axes& axes, const std::string& unit) {
  std::string svg = "<g class=\"grid\">", labels = "<g class=\"ticks\">";
  const double step_y = round_step(axes.most / 6), step_x = round_step(axes.end / 7);
  for (double v = 0; v <= axes.most * (1 + 1e-9); v += step_y) {
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\"/>", left, axes.y(v), width - right);
    labels += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", left - 5,
                          axes.y(v) + 4, shown_number(v));
  }
  for (double t = 0; t <= axes.end * (1 + 1e-9); t += step_x)
    labels += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>",
                          axes.x(t), height - bottom + 14, shown_number(t));
  labels += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>"
      "<text transform=\"translate(11 {:.1f}) rotate(-90)\" text-anchor=\"middle\">[{}]</text>",
      (left + width - right) / 2, height - 4, html_escape(tr("js.time_s")),
      (top + height - bottom) / 2, html_escape(unit));
  return svg + "</g>" + labels + "</g>";
}

std::string path_of(const Axes& axes, const std::vector<double>& times,
                    const std::vector<double>& values) {
  std::string d;
  bool drawn = false;  // the pen is down: a value that is not known lifts it
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isnan(values[i]))
      d += fmt::format("{}{:.1f} {:.1f}", drawn ? "L" : "M", axes.x(times[i]), axes.y(values[i]));
    drawn = !std::isnan(values[i]);
  }
  return d;
}

}  // namespace

/// End of an axis that holds `most`; finer than the ticks, so that little room is wasted.
double round_top(double most) {
  return round_up(std::max(most, 1e-3),
                  std::array{1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0});
}

std::vector<double> motion_times(const MemberHistory& history) {
  return column(history, &HistoryRow::time_s);
}

std::vector<MotionChart> motion_charts(const MemberHistory& history) {
  if (history.rows.size() < 2) return {};
  std::vector<MotionChart> charts{travel(history), speed(history)};
  if (history.has_states) charts.push_back(states(history));
  return charts;
}

std::string motion_chart_svg(const MotionChart& chart, const std::vector<double>& times) {
  const Axes axes{times.back(), chart.top};
  std::string svg = fmt::format(
      "<svg class=\"still-chart\" viewBox=\"0 0 {} {}\" role=\"img\" "
      "aria-label=\"{}\">",
      width, height, html_escape(chart.title));
  if (chart.stacked) {  // the uppermost first: each covers what is not its own
    std::for_each(chart.lines.rbegin(), chart.lines.rend(), [&](const MotionLine& line) {
      svg += fmt::format("<path class=\"area paint-{}\" d=\"{}V{:.1f}H{:.1f}Z\"/>", line.paint,
                         path_of(axes, times, line.values), axes.y(0), axes.x(times.front()));
    });
    return svg + grid_svg(axes, chart.unit) + "</svg>";
  }
  svg += grid_svg(axes, chart.unit);
  for (const MotionLine& line : chart.lines)
    svg += fmt::format("<path class=\"line paint-{}\" d=\"{}\"/>", line.paint,
                       path_of(axes, times, line.values));
  return svg + "</svg>";
}

}  // namespace sturz
