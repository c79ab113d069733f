// SPDX-License-Identifier: Apache-2.0
/// Named maps of results with their meaning: what ensemble computes, io stores and reports draw.
///
/// It lies in scenarios because a scene asks for its maps (HazardSpec: thresholds, quantiles), and
/// because io and ensemble, which do not see each other, both see scenarios.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/layers/layer_meaning.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// One extra coordinate of a layer: thresholds or quantile levels, see LayerMeaning.
struct LayerAxis {
  std::string name;           ///< netCDF dimension and variable name, e.g. "thickness_threshold"
  std::string standard_name;  ///< CF standard name or empty
  std::string units;          ///< UDUNITS text, "1" for fractions
  std::vector<double> values;
};

/// A whole number that stands for a class and is no amount.
struct LayerClass {
  int value = 0;
  std::string words;  ///< letters, digits and single spaces
  bool operator==(const LayerClass&) const = default;
};

/// One named field of results: [axis.values.size() or 1][n_rows][n_cols], NaN where undefined.
struct Layer {
  std::string name;  ///< variable name, e.g. "thickness_exceedance"
  LayerMeaning meaning;
  std::string long_name;
  std::string standard_name;  ///< CF standard name or empty
  std::string units;          ///< UDUNITS text
  std::string cell_methods;   ///< CF cell_methods or empty
  std::string comment;        ///< free text (rules, 'not resolved' notes) or empty
  LayerAxis axis;             ///< empty values: a plain map
  std::vector<float> values;  ///< empty where layers are only described, see layer_stream.hpp
  /// Members behind the values whose end was not seen: probabilities and peaks are lower bounds.
  int n_censored = 0;
  /// Of the interval that a bound is an end of: 0.95; 0 where the layer is no bound.
  double confidence = 0;
  /// All that the values may be besides 0 (none of them), rising; empty: values are amounts.
  std::vector<LayerClass> classes{};

  std::size_t n_planes() const { return axis.values.empty() ? 1 : axis.values.size(); }
  /// Whole numbers: stored as int32, never quantised.
  bool is_count() const { return meaning.statistic == Statistic::count; }
};

/// A map without axis, standard name and cell methods.
inline Layer plain_layer(std::string name, LayerMeaning meaning, std::string long_name,
                         std::string units, std::string comment) {
  Layer layer;
  layer.name = std::move(name);
  layer.meaning = meaning;
  layer.long_name = std::move(long_name);
  layer.units = std::move(units);
  layer.comment = std::move(comment);
  return layer;
}

/// The lower or upper end of the interval of a probability that `meaning` names.
inline Layer bound_layer(std::string name, LayerMeaning bound, const std::string& meaning,
                         double confidence, std::string comment) {
  const bool lower = bound.statistic == Statistic::lower_bound;
  const std::string level = std::to_string(std::lround(100 * confidence));
  Layer layer = plain_layer(
      std::move(name), bound,
      meaning + (lower ? ", lower end of the " : ", upper end of the ") + level + " % interval",
      "1", std::move(comment));
  layer.confidence = confidence;
  return layer;
}

/// Everything that one results file holds, in the order in which it is written.
struct LayerStack {
  Grid grid;
  std::vector<Layer> layers;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< global text attributes
  int joined = 1;  ///< cells of the result files in one of these, per direction

  const Layer* find(const std::string& name) const {
    for (const auto& l : layers)
      if (l.name == name) return &l;
    return nullptr;
  }
};

}  // namespace sturz
