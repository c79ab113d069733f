// SPDX-License-Identifier: Apache-2.0
/// How a page names the maps of results, which of them it shows, and which one first.
#pragma once

#include "scenarios/layers/layer_stack.hpp"

#include <string>
#include <vector>

namespace sturz {

/// "Flow thickness", "Kinetic energy per area", ...
std::string title(Quantity quantity);
/// "Thickness", "Energy", ...: where it is said already which material it is of.
std::string short_title(Quantity quantity);

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
