// SPDX-License-Identifier: Apache-2.0
/// The layers of a hazard map before they are filled: names, units, axes, rules in words.
#pragma once

#include "scenarios/layers/layer_stack.hpp"
#include "scenarios/scenario.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

/// A probability and its Wilson bounds: places in LayerStack::layers.
struct ProbabilityLayers {
  std::size_t probability = 0, lower = 0, upper = 0;
  std::vector<float> thresholds;  ///< [SI], one per plane; unused for a plain map
};

/// What is made of one member layer.
struct QuantityLayers {
  PeakLayer source = PeakLayer::thickness;
  double units_per_si = 1;  ///< maps speak the units of the scenario's thresholds
  std::optional<ProbabilityLayers> exceedance;
  std::optional<std::size_t> mean, quantile;
};

/// Whether and when the flow, or one of its materials, comes.
struct ReachLayers {
  PeakLayer source = PeakLayer::arrival;  ///< NaN where it does not come
  ProbabilityLayers reached;
  std::optional<std::size_t> quantile;  ///< of the time, over the members that come
};

/// Everything that make_hazard_map fills; indices into `stack.layers`.
struct HazardLayers {
  LayerStack stack;              ///< without values
  std::vector<float> untouched;  ///< of each layer: a cell of known ground that no member reached
  std::vector<ReachLayers> reaches;      ///< of the flow first, then of grains and of liquid
  std::optional<std::size_t> mass_left;  ///< where some member's mass crossed the edge
  std::vector<QuantityLayers>
      quantities;  ///< thickness, speed, energy, pressure, deposit, eroded depth; of each material
  std::optional<std::size_t> liquid_fraction;  ///< quantile over the members that reach the cell
  std::size_t high_intensity = 0, medium_intensity = 0;
};

/// What only some scenes have maps of.
struct HazardExtras {
  bool left = false;    ///< mass of some member crossed the edge of the known ground
  bool eroded = false;  ///< the flow takes its bed along
  bool phases = false;  ///< grains and liquid move apart
  /// Members whose end was not seen as far as grains, and as far as liquid is concerned.
  std::int64_t n_censored_grains = 0, n_censored_liquid = 0;
  /// Members do not count alike, and are worth so many that do; nothing: they do.
  std::optional<double> effective_members = std::nullopt;
};

/// All layers, and what a cell holds that no member touched: probability 0 (upper bound that of 0
/// out of n_members), peaks 0, arrival NaN; without members everything is NaN. \param n_censored of
/// these members: their end was not seen, so probabilities are lower bounds
HazardLayers hazard_layers(const Grid& grid, const HazardSpec& spec, double spacing_m,
                           std::int64_t n_members, std::int64_t n_censored = 0,
                           const HazardExtras& extras = {});

/// "weighted by posterior, effective members = 23.4": what every weighted map says of itself.
std::string weighting_text(double effective_members);

}  // namespace sturz
