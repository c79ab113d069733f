// SPDX-License-Identifier: Apache-2.0
#include "reports/layer_meaning.hpp"

#include "reports/page/text.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace sturz {
namespace {

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

LayerMeaning meaning_of(const Layer& layer) {
  const std::string& n = layer.name;
  LayerMeaning m;
  if (n.starts_with("number_of") || n.starts_with("count"))
    m.quantity = Quantity::count;
  else if (has(n, "deposit"))
    m.quantity = Quantity::deposit;
  else if (has(n, "arrival"))
    m.quantity = Quantity::arrival;
  else if (has(n, "thickness"))
    m.quantity = Quantity::thickness;
  else if (has(n, "speed") || has(n, "velocity"))
    m.quantity = Quantity::speed;
  else if (has(n, "energy"))
    m.quantity = Quantity::energy;
  else if (has(n, "pressure"))
    m.quantity = Quantity::pressure;
  else if (has(n, "intensity"))
    m.quantity = Quantity::intensity;
  else if (has(n, "reached"))
    m.quantity = Quantity::reached;
  if (has(n, "lower"))
    m.statistic = Statistic::lower_bound;
  else if (has(n, "upper"))
    m.statistic = Statistic::upper_bound;
  else if (has(n, "probab"))
    m.statistic = Statistic::probability;
  else if (has(n, "quantile") || has(n, "percentile"))
    m.statistic = Statistic::quantile;
  else if (has(n, "mean"))
    m.statistic = Statistic::mean;
  else if (n.starts_with("peak") || n.starts_with("max") || n.starts_with("deposit") ||
           n.starts_with("arrival"))
    m.statistic = Statistic::peak;
  return m;
}

std::string word(Quantity q) {
  switch (q) {
    case Quantity::reached:
      return "reached";
    case Quantity::thickness:
      return "thickness";
    case Quantity::speed:
      return "speed";
    case Quantity::energy:
      return "energy";
    case Quantity::pressure:
      return "pressure";
    case Quantity::arrival:
      return "arrival";
    case Quantity::deposit:
      return "deposit";
    case Quantity::intensity:
      return "intensity";
    case Quantity::count:
      return "count";
    case Quantity::other:
      break;
  }
  return "other";
}

std::string word(Statistic s) {
  switch (s) {
    case Statistic::probability:
      return "probability";
    case Statistic::lower_bound:
      return "lower";
    case Statistic::upper_bound:
      return "upper";
    case Statistic::quantile:
      return "quantile";
    case Statistic::mean:
      return "mean";
    case Statistic::peak:
      return "peak";
    case Statistic::other:
      break;
  }
  return "value";
}

std::string title(Quantity q) {
  switch (q) {
    case Quantity::reached:
      return "Reached";
    case Quantity::thickness:
      return "Flow thickness";
    case Quantity::speed:
      return "Flow speed";
    case Quantity::energy:
      return "Kinetic energy per area";
    case Quantity::pressure:
      return "Dynamic pressure";
    case Quantity::arrival:
      return "Arrival time";
    case Quantity::deposit:
      return "Deposit thickness";
    case Quantity::intensity:
      return "Intensity";
    case Quantity::count:
      return "Count";
    case Quantity::other:
      break;
  }
  return "Other";
}

std::string plane_label(const Layer& layer, std::size_t plane) {
  const LayerMeaning meaning = meaning_of(layer);
  if (meaning.quantity == Quantity::intensity)
    for (const char* level : {"high", "medium", "low"})
      if (has(layer.name, level)) return level;
  if (layer.axis.values.empty())
    return meaning.quantity == Quantity::reached ? "reached" : word(meaning.statistic);
  const double value = layer.axis.values[plane];
  if (meaning.statistic == Statistic::quantile)
    return value == 0.5 ? "median" : number_text(100 * value) + "\u00A0% quantile";
  return (meaning.statistic == Statistic::probability ? ">\u00A0" : "") +
         with_unit(value, layer.axis.units);
}

std::string plane_title(const Layer& layer, std::size_t plane) {
  const LayerMeaning meaning = meaning_of(layer);
  const std::string what = title(meaning.quantity);
  std::string lower = what;
  lower[0] = static_cast<char>(lower[0] - 'A' + 'a');
  if (meaning.quantity == Quantity::other || meaning.quantity == Quantity::count) {
    const std::string base = layer.long_name.empty() ? words(layer.name) : layer.long_name;
    return layer.axis.values.empty() ? base : base + ", " + plane_label(layer, plane);
  }
  switch (meaning.statistic) {
    case Statistic::probability:
      if (meaning.quantity == Quantity::reached) return "Probability that the flow arrives";
      if (meaning.quantity == Quantity::intensity)
        return "Probability of " + plane_label(layer, plane) + " intensity";
      if (layer.axis.values.empty()) return "Probability of " + lower;
      return "Probability that " + lower + " exceeds " +
             with_unit(layer.axis.values[plane], layer.axis.units);
    case Statistic::quantile:
      return what + ", " +
             (layer.axis.values.empty() ? std::string("quantile") : plane_label(layer, plane));
    case Statistic::mean:
      return what + ", mean of members";
    case Statistic::peak:
      return meaning.quantity == Quantity::arrival || meaning.quantity == Quantity::deposit
                 ? what
                 : "Peak " + lower;
    default:
      break;
  }
  return layer.long_name.empty() ? words(layer.name) : layer.long_name;
}

std::vector<const Layer*> shown_layers(const LayerStack& maps) {
  std::vector<const Layer*> shown;
  for (const Layer& layer : maps.layers) {
    const LayerMeaning m = meaning_of(layer);
    if (m.quantity == Quantity::count || m.statistic == Statistic::lower_bound ||
        m.statistic == Statistic::upper_bound)
      continue;
    const bool defined = std::any_of(layer.values.begin(), layer.values.end(),
                                     [](float v) { return std::isfinite(v); });
    if (defined && layer.values.size() == layer.n_planes() * maps.grid.n_cells())
      shown.push_back(&layer);
  }
  return shown;
}

const Layer* default_layer(const LayerStack& maps) {
  const auto shown = shown_layers(maps);
  const auto pick = [&](Quantity q, Statistic s) -> const Layer* {
    for (const Layer* l : shown) {
      const LayerMeaning m = meaning_of(*l);
      if (m.quantity == q && m.statistic == s) return l;
    }
    return nullptr;
  };
  for (const auto& [q, s] : {std::pair{Quantity::reached, Statistic::probability},
                             std::pair{Quantity::thickness, Statistic::probability},
                             std::pair{Quantity::thickness, Statistic::peak}})
    if (const Layer* found = pick(q, s)) return found;
  return shown.empty() ? nullptr : shown.front();
}

}  // namespace sturz
