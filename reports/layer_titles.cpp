// SPDX-License-Identifier: Apache-2.0
#include "reports/layer_titles.hpp"

#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"
#include "scenarios/layers/source_lists.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace sturz {
namespace {

std::string key_of(Quantity q) { return fmt::format("quantity.{}", to_string(q)); }

/// As it stands inside a sentence.
std::string title_inside(Quantity q) { return tr(key_of(q) + ".inside"); }

}  // namespace

std::string title(Quantity q) { return tr(key_of(q)); }

std::string short_title(Quantity q) {
  std::string name(to_string(q));
  if (q == Quantity::liquid_fraction) return tr("short.liquid_fraction");
  if (q == Quantity::solid || q == Quantity::liquid) name = "thickness";
  for (const std::string_view material : {"solid_", "liquid_"})
    if (name.starts_with(material)) name.erase(0, material.size());
  return tr(fmt::format("short.{}", name));
}

std::string plane_label(const Layer& layer, std::size_t plane) {
  const LayerMeaning& meaning = layer.meaning;
  if (meaning.intensity != IntensityClass::none)
    return tr(fmt::format("intensity.{}", to_string(meaning.intensity)));
  if (layer.axis.values.empty()) {
    if (is_whether_reached(meaning.quantity)) return tr("plane.reached");
    if (meaning.quantity == Quantity::sources) return words(layer.name);
    return tr(fmt::format("plane.{}", to_string(meaning.statistic)));
  }
  const double value = layer.axis.values[plane];
  if (meaning.statistic == Statistic::quantile || meaning.statistic == Statistic::source_quantile)
    return value == 0.5 ? tr("plane.median") : tr("plane.quantile_of", shown_number(100 * value));
  return (meaning.statistic == Statistic::probability ? ">\u00A0" : "") +
         with_unit(value, layer.axis.units);
}

std::string plane_title(const Layer& layer, std::size_t plane) {
  const LayerMeaning& meaning = layer.meaning;
  const std::string what = title(meaning.quantity);
  const std::string lower = title_inside(meaning.quantity);
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
        return layer.name == likeliest_source_layer ? tr("title.likeliest") : tr("title.flow");
      if (meaning.quantity == Quantity::solid_reached) return tr("title.grains");
      if (meaning.quantity == Quantity::liquid_reached) return tr("title.liquid");
      if (meaning.quantity == Quantity::left) return tr("title.left");
      if (meaning.quantity == Quantity::intensity)
        return tr("title.intensity", plane_label(layer, plane));
      if (layer.axis.values.empty()) return tr("title.probability_of", lower);
      return tr("title.exceeds", lower, with_unit(layer.axis.values[plane], layer.axis.units));
    case Statistic::quantile:
      return what + ", " +
             (layer.axis.values.empty() ? tr("plane.quantile") : plane_label(layer, plane));
    case Statistic::source_quantile:
      return tr("title.worst_source", what, plane_label(layer, plane));
    case Statistic::mean:
      return tr("title.mean", what);
    case Statistic::peak:
      if (meaning.quantity == Quantity::liquid_fraction) return tr("title.thickest", what);
      return is_arrival(meaning.quantity) || meaning.quantity == Quantity::deposit ||
                     meaning.quantity == Quantity::left || meaning.quantity == Quantity::eroded
                 ? what
                 : tr("title.peak", lower);
    case Statistic::difference: {
      Layer of;  // without the values
      of.name = layer.name, of.meaning = layer.meaning, of.axis = layer.axis;
      of.meaning.statistic = Statistic::probability;
      return tr("title.difference", plane_title(of, plane));
    }
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
