// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/legend.hpp"

#include "reports/texts/text_table.hpp"
#include "scenarios/layers/source_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace sturz {
namespace {

std::string range_label(double lower, double upper) {
  return shown_number(lower) + "\u2013" + shown_number(upper);
}

/// Fills in labels and colours for classes that start at `lowers`.
void dress(Legend& legend, const std::vector<double>& lowers, Ramp ramp) {
  const auto colours = ramp_colours(ramp, static_cast<int>(lowers.size()));
  const double factor = legend.probability ? 100 : 1;
  for (std::size_t i = 0; i < lowers.size(); ++i) {
    LegendClass c{lowers[i], "", colours[i]};
    const bool last = i + 1 == lowers.size();
    if (last)
      c.label = "\u2265\u00A0" + shown_number(factor * lowers[i]);
    else if (i == 0 && legend.clear_zero)
      c.label = "<\u00A0" + shown_number(factor * lowers[1]);
    else
      c.label = range_label(factor * lowers[i], factor * lowers[i + 1]);
    if (legend.probability) c.label += "\u00A0%";
    legend.classes.push_back(std::move(c));
  }
}

/// Largest number of the series ..., 0.1, 0.2, 0.5, 1, 2, 5, ... that is <= value (value > 0).
double nice_below(double value) {
  const double power = std::pow(10, std::floor(std::log10(value) + 1e-12));
  for (const double step : {5.0, 2.0, 1.0})
    if (step * power <= value * (1 + 1e-9)) return step * power;
  return power;
}

std::vector<double> series_classes(double largest) {
  std::vector<double> lowers;
  double at = nice_below(largest);
  for (int i = 0; i < 6; ++i) {
    lowers.push_back(at);
    at = nice_below(at * 0.999);
  }
  lowers.push_back(0);
  std::reverse(lowers.begin(), lowers.end());
  return lowers;
}

std::vector<double> even_classes(double largest) {
  const double step = nice_below(std::max(largest, 1e-9) / 3);
  std::vector<double> lowers;
  for (double at = 0; at <= largest && lowers.size() < 9; at += step) lowers.push_back(at);
  return lowers;
}

Ramp ramp_of(const LayerMeaning& meaning) {
  if (meaning.statistic == Statistic::probability || meaning.is_bound()) return Ramp::hazard;
  switch (meaning.quantity) {
    case Quantity::arrival:
    case Quantity::solid_arrival:
    case Quantity::liquid_arrival:
      return Ramp::arrival;
    case Quantity::deposit:
    case Quantity::eroded:
      return Ramp::deposit;
    case Quantity::intensity:
      return Ramp::hazard;
    case Quantity::members:
    case Quantity::sources:
    case Quantity::other:
      return Ramp::neutral;
    default:
      return Ramp::magnitude;
  }
}

/// Hues a golden angle apart: neighbours in the list differ, and none returns.
std::vector<Rgb> unordered_colours(std::size_t n) {
  std::vector<Rgb> colours;
  for (std::size_t i = 0; i < n; ++i) {
    const double hue = std::fmod(0.6180339887498949 * static_cast<double>(i) + 0.58, 1.0) * 6;
    // Three values and two strengths in turn, for readers who see few hues.
    const double value = std::array{0.85, 0.62, 0.45}[i % 3], strength = i % 2 == 0 ? 0.75 : 0.5;
    const auto channel = [&](double shift) {
      const double k = std::fmod(shift + hue, 6.0);
      const double share = std::clamp(std::min(k, 4 - k), 0.0, 1.0);
      return static_cast<std::uint8_t>(std::lround(255 * value * (1 - strength * share)));
    };
    colours.push_back({channel(5), channel(3), channel(1)});
  }
  return colours;
}

/// One class of each number, in greys: which field has which colour is not the program's to say.
void name_classes(Legend& legend, const Layer& layer) {
  legend.nominal = layer.meaning.quantity == Quantity::sources;
  const auto colours = legend.nominal
                           ? unordered_colours(layer.classes.size())
                           : ramp_colours(Ramp::neutral, static_cast<int>(layer.classes.size()));
  for (std::size_t i = 0; i < layer.classes.size(); ++i)
    legend.classes.push_back({static_cast<double>(layer.classes[i].value),
                              fmt::format("{}: {}", layer.classes[i].value, layer.classes[i].words),
                              colours[i]});
}

/// Less in the colours of magnitudes, more in those of hazards, both pale next to 0.
void dress_difference(Legend& legend) {
  constexpr std::array<double, 6> edges{0, 0.05, 0.1, 0.25, 0.5, 1};
  constexpr std::size_t n = edges.size() - 1;
  legend.diverging = true;
  const auto less = ramp_colours(Ramp::magnitude, n), more = ramp_colours(Ramp::hazard, n);
  const auto label = [&](const char* key, std::size_t k) {
    const std::string range = k + 1 == n ? "\u2265\u00A0" + shown_number(100 * edges[k])
                                         : range_label(100 * edges[k], 100 * edges[k + 1]);
    return tr(key, range);
  };
  for (std::size_t k = n; k-- > 0;)
    legend.classes.push_back({-edges[k + 1], label("legend.less", k), less[k]});
  for (std::size_t k = 0; k < n; ++k)
    legend.classes.push_back({edges[k], label("legend.more", k), more[k]});
}

std::string legend_title(const Layer& layer, const DisplayUnit& unit) {
  if (layer.meaning.statistic == Statistic::difference) return tr("legend.difference");
  if (layer.meaning.statistic == Statistic::probability) {
    if (layer.meaning.quantity == Quantity::sources) return tr("legend.every_source");
    if (layer.name == likeliest_source_layer) return tr("legend.likeliest");
    // As ensemble/hazard/hazard_layers.cpp says it of members that do not count alike.
    const bool weighted = layer.comment.starts_with("weight of the members");
    return tr(weighted ? "legend.share_weighted" : "legend.share");
  }
  const bool named =
      layer.meaning.quantity != Quantity::other && layer.meaning.quantity != Quantity::sources;
  return (named ? title(layer.meaning.quantity) : words(layer.name)) +
         (unit.label.empty() ? "" : " [" + unit.label + "]");
}

}  // namespace

int Legend::class_of(float stored) const {
  if (std::isnan(stored) || (clear_zero && (diverging ? stored == 0 : stored <= 0))) return -1;
  const double shown = unit.factor * static_cast<double>(stored);
  if (nominal) {
    const auto place = std::lround(shown - classes.front().lower);
    return place >= 0 && place < std::ssize(classes) ? static_cast<int>(place) : -1;
  }
  int found = 0;
  for (std::size_t i = 1; i < classes.size(); ++i)
    if (shown >= classes[i].lower - 1e-6 * std::abs(classes[i].lower)) found = static_cast<int>(i);
  return found;
}

Legend legend_for(const Layer& layer) {
  const LayerMeaning& meaning = layer.meaning;
  Legend legend;
  legend.unit = display_unit(layer.units);
  legend.title = legend_title(layer, legend.unit);
  legend.probability = (meaning.statistic == Statistic::probability ||
                        meaning.statistic == Statistic::difference || meaning.is_bound()) &&
                       layer.units == "1";
  const bool is_share = meaning.quantity == Quantity::liquid_fraction;
  legend.clear_zero = !is_arrival(meaning.quantity) && !is_share;
  double largest = 0;
  for (const float v : layer.values)
    if (std::isfinite(v)) largest = std::max(largest, legend.unit.factor * v);
  if (!layer.classes.empty())
    name_classes(legend, layer);
  else if (meaning.statistic == Statistic::difference)
    dress_difference(legend);
  else if (legend.probability)
    dress(legend, {0, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9}, Ramp::hazard);
  else if (is_arrival(meaning.quantity) || meaning.quantity == Quantity::intensity || is_share ||
           largest <= 0)
    dress(legend, even_classes(largest), ramp_of(meaning));
  else
    dress(legend, series_classes(largest), ramp_of(meaning));
  return legend;
}

}  // namespace sturz
