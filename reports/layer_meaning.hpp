// SPDX-License-Identifier: Apache-2.0
/// What a layer of results means to a reader: quantity, statistic, titles, which one to show first.
#pragma once

#include "engine/terrain/raster.hpp"

#include <string>
#include <vector>

namespace sturz {

enum class Quantity {
  reached,
  thickness,
  speed,
  energy,
  pressure,
  arrival,
  deposit,
  intensity,
  count,
  other
};
enum class Statistic { probability, lower_bound, upper_bound, quantile, mean, peak, other };

/// Read from the layer's name, so that any LayerStack can be shown.
struct LayerMeaning {
  Quantity quantity = Quantity::other;
  Statistic statistic = Statistic::other;
};
LayerMeaning meaning_of(const Layer& layer);
/// Lower-case word for the page's data and switches, e.g. "thickness".
std::string word(Quantity quantity);
std::string word(Statistic statistic);
/// "Flow thickness", "Kinetic energy per area", ...
std::string title(Quantity quantity);

/// "reached", "> 0.5 m", "5 % quantile": the title of one plane of a layer, without its quantity.
std::string plane_label(const Layer& layer, std::size_t plane);
/// The whole title: "Probability that flow thickness exceeds 0.5 m".
std::string plane_title(const Layer& layer, std::size_t plane);

/// Layers that get a map of their own: no counts, no bounds, nothing that is undefined everywhere.
std::vector<const Layer*> shown_layers(const LayerStack& maps);
/// The first of shown_layers to look at: P(reached), else P(thickness), else peak thickness, else
/// any; nullptr when there is none.
const Layer* default_layer(const LayerStack& maps);

}  // namespace sturz
