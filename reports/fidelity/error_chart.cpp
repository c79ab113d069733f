// SPDX-License-Identifier: Apache-2.0
#include "reports/fidelity/error_chart.hpp"

#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sturz {
namespace {

constexpr double width = 420, height = 260, left = 52, right = 16, top = 12, bottom = 36;

bool is_shown(double seconds, double error) {
  return std::isfinite(seconds) && seconds > 0 && std::isfinite(error) && error > 0;
}

double power_below(double value) { return std::pow(10, std::floor(std::log10(value) + 1e-9)); }
double power_above(double value) { return std::pow(10, std::ceil(std::log10(value) - 1e-9)); }

struct Places {
  ErrorAxes axes;
  double x(double seconds) const {
    return left + (width - left - right) * std::log(seconds / axes.least_s) /
                      std::log(axes.most_s / axes.least_s);
  }
  double y(double error) const {
    return height - bottom -
           (height - top - bottom) * std::log(error / axes.least_error) /
               std::log(axes.most_error / axes.least_error);
  }
};

std::string grid_svg(const Places& at) {
  std::string svg = "<g class=\"grid\">", labels = "<g class=\"ticks\">";
  for (double e = at.axes.least_error; e <= at.axes.most_error * 1.01; e *= 10) {
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\"/>", left, at.y(e), width - right);
    labels += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:g} %</text>",
                          left - 5, at.y(e) + 4, 100 * e);
  }
  for (double s = at.axes.least_s; s <= at.axes.most_s * 1.01; s *= 10) {
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}\"/>", at.x(s), top, height - bottom);
    labels += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:g}</text>",
                          at.x(s), height - bottom + 15, s);
  }
  labels += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">computing time of a member "
      "[s]</text>",
      (left + width - right) / 2, height - 4);
  return svg + "</g>" + labels + "</g>";
}

std::string line_svg(const Places& at, const ErrorLine& line) {
  std::string path, dots;
  for (std::size_t i = 0; i < line.seconds.size(); ++i) {
    if (!is_shown(line.seconds[i], line.errors[i])) continue;
    const double x = at.x(line.seconds[i]), y = at.y(line.errors[i]);
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
    dots += fmt::format(
        "<circle class=\"dot paint-{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/>"
        "<text class=\"dot-note\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>",
        line.paint, x, y, x, y - 8, html_escape(line.notes[i]));
  }
  return fmt::format("<path class=\"line paint-{}\" d=\"{}\"/>{}", line.paint, path, dots);
}

}  // namespace

ErrorAxes axes_for(const std::vector<ErrorLine>& lines) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double least_s = infinity, most_s = 0, least_error = infinity, most_error = 0;
  for (const ErrorLine& line : lines)
    for (std::size_t i = 0; i < line.seconds.size(); ++i) {
      if (!is_shown(line.seconds[i], line.errors[i])) continue;
      least_s = std::min(least_s, line.seconds[i]);
      most_s = std::max(most_s, line.seconds[i]);
      least_error = std::min(least_error, line.errors[i]);
      most_error = std::max(most_error, line.errors[i]);
    }
  if (most_s == 0) return {};
  ErrorAxes axes{power_below(least_s), power_above(most_s), power_below(least_error),
                 power_above(most_error)};
  if (axes.most_s <= axes.least_s * 1.01) axes.most_s = 10 * axes.least_s;
  if (axes.most_error <= axes.least_error * 1.01) axes.most_error = 10 * axes.least_error;
  return axes;
}

std::string error_chart_svg(const std::string& title, const std::vector<ErrorLine>& lines,
                            const ErrorAxes& axes, double wanted) {
  const Places at{axes};
  std::string svg = fmt::format(
      "<svg class=\"still-chart\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", width,
      height, html_escape(title));
  svg += grid_svg(at);
  if (wanted > axes.least_error && wanted < axes.most_error)
    svg += fmt::format("<path class=\"wanted\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", left, at.y(wanted),
                       width - right);
  for (const ErrorLine& line : lines) svg += line_svg(at, line);
  return svg + "</svg>";
}

}  // namespace sturz
