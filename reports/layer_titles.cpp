// SPDX-License-Identifier: Apache-2.0
#include "reports/layer_titles.hpp"

#include "reports/page/text.hpp"
#include "scenarios/layers/source_lists.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace sturz {
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
    case Quantity::left:
      return "Mass past the terrain's edge";
    case Quantity::eroded:
      return "Eroded depth";
    case Quantity::solid:
      return "Thickness of grains without their pores";
    case Quantity::liquid:
      return "Thickness of liquid alone";
    case Quantity::intensity:
      return "Intensity";
    case Quantity::members:
      return "Members";
    case Quantity::sources:
      return "Sources";
    case Quantity::solid_reached:
      return "Reached by grains";
    case Quantity::solid_speed:
      return "Speed of the grains";
    case Quantity::solid_energy:
      return "Kinetic energy of the grains per area";
    case Quantity::solid_pressure:
      return "Dynamic pressure of the grains";
    case Quantity::solid_arrival:
      return "Arrival time of grains";
    case Quantity::liquid_reached:
      return "Reached by liquid";
    case Quantity::liquid_speed:
      return "Speed of the liquid";
    case Quantity::liquid_energy:
      return "Kinetic energy of the liquid per area";
    case Quantity::liquid_pressure:
      return "Dynamic pressure of the liquid";
    case Quantity::liquid_arrival:
      return "Arrival time of liquid";
    case Quantity::liquid_fraction:
      return "Share of liquid in the flow's volume";
    case Quantity::other:
      break;
  }
  return "Other";
}

std::string short_title(Quantity q) {
  if (q == Quantity::liquid_fraction) return "Share of liquid";
  std::string name(to_string(q));
  if (q == Quantity::solid || q == Quantity::liquid) name = "thickness";
  for (const std::string_view material : {"solid_", "liquid_"})
    if (name.starts_with(material)) name.erase(0, material.size());
  name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return name;
}

std::string plane_label(const Layer& layer, std::size_t plane) {
  const LayerMeaning& meaning = layer.meaning;
  if (meaning.intensity != IntensityClass::none) return std::string(to_string(meaning.intensity));
  if (layer.axis.values.empty()) {
    if (is_whether_reached(meaning.quantity)) return "reached";
    if (meaning.quantity == Quantity::sources) return words(layer.name);
    return std::string(to_string(meaning.statistic));
  }
  const double value = layer.axis.values[plane];
  if (meaning.statistic == Statistic::quantile || meaning.statistic == Statistic::source_quantile)
    return value == 0.5 ? "median" : shown_number(100 * value) + "\u00A0% quantile";
  return (meaning.statistic == Statistic::probability ? ">\u00A0" : "") +
         with_unit(value, layer.axis.units);
}

std::string plane_title(const Layer& layer, std::size_t plane) {
  const LayerMeaning& meaning = layer.meaning;
  const std::string what = title(meaning.quantity);
  std::string lower = what;
  lower[0] = static_cast<char>(lower[0] - 'A' + 'a');
  if (meaning.quantity == Quantity::other || meaning.quantity == Quantity::members ||
      meaning.quantity == Quantity::sources) {
    std::string base = layer.long_name.empty() ? words(layer.name) : layer.long_name;
    if (meaning.quantity == Quantity::sources && base[0] >= 'a' && base[0] <= 'z')
      base[0] = static_cast<char>(base[0] - 'a' + 'A');
    return layer.axis.values.empty() ? base : base + ", " + plane_label(layer, plane);
  }
  switch (meaning.statistic) {
    case Statistic::probability:
      if (meaning.quantity == Quantity::reached)
        return layer.name == likeliest_source_layer
                   ? "Probability that the likeliest source arrives"
                   : "Probability that the flow arrives";
      if (meaning.quantity == Quantity::solid_reached) return "Probability that grains arrive";
      if (meaning.quantity == Quantity::liquid_reached) return "Probability that liquid arrives";
      if (meaning.quantity == Quantity::left)
        return "Probability that mass leaves the known terrain";
      if (meaning.quantity == Quantity::intensity)
        return "Probability of " + plane_label(layer, plane) + " intensity";
      if (layer.axis.values.empty()) return "Probability of " + lower;
      return "Probability that " + lower + " exceeds " +
             with_unit(layer.axis.values[plane], layer.axis.units);
    case Statistic::quantile:
      return what + ", " +
             (layer.axis.values.empty() ? std::string("quantile") : plane_label(layer, plane));
    case Statistic::source_quantile:
      return what + ", " + plane_label(layer, plane) + " of the worst source";
    case Statistic::mean:
      return what + ", mean of members";
    case Statistic::peak:
      if (meaning.quantity == Quantity::liquid_fraction) return what + " when it was thickest";
      return is_arrival(meaning.quantity) || meaning.quantity == Quantity::deposit ||
                     meaning.quantity == Quantity::left || meaning.quantity == Quantity::eroded
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
    if (layer.is_count() || layer.meaning.is_bound()) continue;
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
    for (const Layer* l : shown)
      if (l->meaning.quantity == q && l->meaning.statistic == s) return l;
    return nullptr;
  };
  for (const auto& [q, s] : {std::pair{Quantity::reached, Statistic::probability},
                             std::pair{Quantity::thickness, Statistic::probability},
                             std::pair{Quantity::thickness, Statistic::peak}})
    if (const Layer* found = pick(q, s)) return found;
  return shown.empty() ? nullptr : shown.front();
}

}  // namespace sturz
