// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/posterior_figures.hpp"

#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace sturz {
namespace {

constexpr double width = 320, height = 190, right = 12, top = 10, bottom = 40;
/// Room for numbers beside the vertical axis: for those of seven characters at least.
constexpr double least_left = 44, character = 6.2;
constexpr int n_bins = 20;
constexpr std::size_t most_dots = 400;

struct Range {
  double least = INFINITY, most = -INFINITY;
  void add(std::span<const double> values) {
    for (const double v : values)
      if (std::isfinite(v)) {
        least = std::min(least, v);
        most = std::max(most, v);
      }
  }
  bool empty() const { return !(most > least); }
  double share(double v) const { return (v - least) / (most - least); }
};

/// Where the axis along the page begins and ends.
struct Across {
  double left = least_left;
  double at(double share) const { return left + share * (width - left - right); }
};
double y_of(double share) { return height - bottom - share * (height - top - bottom); }

using Bins = std::array<double, n_bins>;

/// Shares of the values in equal bins of the range.
Bins histogram(std::span<const double> values, const Range& range) {
  Bins bins{};
  double n = 0;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    ++bins[static_cast<std::size_t>(std::clamp(range.share(v) * n_bins, 0.0, n_bins - 1.0))];
    ++n;
  }
  for (double& b : bins) b /= std::max(n, 1.0);
  return bins;
}

std::string steps(const Bins& bins, double most, const Across& x) {
  std::string path = fmt::format("M{:.1f},{:.1f}", x.at(0), y_of(0));
  for (int i = 0; i < n_bins; ++i)
    path += fmt::format("V{:.1f}H{:.1f}", y_of(bins[static_cast<std::size_t>(i)] / most),
                        x.at((i + 1.0) / n_bins));
  return path + fmt::format("V{:.1f}", y_of(0));
}

std::size_t n_characters(std::string_view utf8) {
  return static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;  // not the rest of one
  }));
}

/// The margin that numbers at both ends of the vertical axis need.
Across beside(const std::string& lower, const std::string& upper) {
  const std::size_t longest = std::max(n_characters(lower), n_characters(upper));
  return {std::max(least_left, 6 + character * static_cast<double>(longest))};
}

std::string frame(const std::string& title, const Across& x) {
  return fmt::format(
      "<svg class=\"still-chart\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">"
      "<g class=\"grid\"><path d=\"M{:.1f},{:.1f}H{:.1f}\"/></g>",
      width, height, html_escape(title), x.left, y_of(0), width - right);
}

std::string ticks_x(const Range& range, const std::string& label, const Across& x) {
  std::string text = "<g class=\"ticks\">";
  for (const double share : {0.0, 0.5, 1.0})
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x.at(share),
                        height - bottom + 14,
                        share == 0   ? "start"
                        : share == 1 ? "end"
                                     : "middle",
                        shown_number(range.least + share * (range.most - range.least)));
  return text + fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text></g>",
                            x.at(0.5), height - 8, html_escape(label));
}

}  // namespace

std::string marginal_svg(std::span<const double> before, std::span<const double> after,
                         const std::string& label) {
  Range range;
  range.add(before);
  range.add(after);
  if (range.empty()) return {};
  const Bins was = histogram(before, range), is = histogram(after, range);
  const double most =
      std::max(*std::max_element(was.begin(), was.end()), *std::max_element(is.begin(), is.end()));
  const Across x;  // no numbers beside it
  return frame(label + ": before and after", x) +
         fmt::format("<path class=\"area paint-front\" d=\"{}Z\"/>", steps(is, most, x)) +
         fmt::format("<path class=\"line paint-dense\" d=\"{}\"/>", steps(was, most, x)) +
         ticks_x(range, label, x) + "</svg>";
}

std::string pair_svg(std::span<const double> x_before, std::span<const double> y_before,
                     std::span<const double> x_after, std::span<const double> y_after,
                     const std::string& x_label, const std::string& y_label) {
  Range x, y;
  x.add(x_before);
  x.add(x_after);
  y.add(y_before);
  y.add(y_after);
  if (x.empty() || y.empty()) return {};
  const std::string ends[] = {shown_number(y.least), shown_number(y.most)};
  const Across across = beside(ends[0], ends[1]);
  std::string svg = frame(y_label + " against " + x_label, across);
  const std::size_t n = std::min({x_after.size(), y_after.size(), most_dots});
  for (std::size_t i = 0; i < n; ++i)
    if (std::isfinite(x_after[i]) && std::isfinite(y_after[i]))
      svg += fmt::format("<circle class=\"dot paint-front\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\"/>",
                         across.at(x.share(x_after[i])), y_of(y.share(y_after[i])));
  svg += "<g class=\"ticks\">";
  for (const double share : {0.0, 1.0})
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>",
                       across.left - 4, y_of(share) + 4, ends[share > 0 ? 1 : 0]);
  return svg + "</g>" + ticks_x(x, x_label, across) + "</svg>";
}

}  // namespace sturz
