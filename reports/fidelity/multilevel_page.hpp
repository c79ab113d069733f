// SPDX-License-Identifier: Apache-2.0
/// The page of a multilevel ensemble.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/layers/layer_stack.hpp"

#include <string>
#include <vector>

namespace sturz {

/// One mean, and by how much it may be off in its unit, NaN where not known. Sampling: how far its
/// 90 % bounds lie below and above.
struct MultilevelPageResult {
  std::string name, units;
  double mean = nan_d, below = nan_d, above = nan_d, resolution = nan_d, model = nan_d;
  struct Quantile {
    double level = 0, value = nan_d, low = nan_d, high = nan_d;
  };
  std::vector<Quantile> quantiles;
};

struct MultilevelPageLevel {
  std::string name;
  bool used = false;
  double members = 0, member_cpu_s = nan_d, share_of_seconds = nan_d;
  std::vector<double> shares_of_variance;  ///< [results, map]; empty: not used
};

/// Probabilities at one asset, with 90 % bounds; NaN where it lies beyond the maps.
struct MultilevelPageAsset {
  struct Share {
    double value = nan_d, low = nan_d, high = nan_d;
    bool at_least = false;  ///< a lower bound, because members were cut off before it was known
  };
  std::string name;
  std::vector<Share> shares;  ///< that it is hit, and of each of the page's `exceedances`
};

struct MultilevelPage {
  std::string title, when, program;
  std::vector<std::string> sentences;  ///< what was reached, and at which price
  std::vector<MultilevelPageResult> results;
  std::vector<MultilevelPageLevel> levels;
  std::vector<std::string> exceedances;  ///< "pressure > 30 kPa"
  std::vector<MultilevelPageAsset> assets;
  const LayerStack* maps = nullptr;           ///< P(reached) with its bounds among them
  std::string upper_bound_note;               ///< what no colour means on the map of upper bounds
  const Raster<double>* elevation = nullptr;  ///< may be null
  std::vector<std::string> warnings;
};

/// The whole page as UTF-8 text: no script, no other file, no network.
std::string make_multilevel_page(const MultilevelPage&);

}  // namespace sturz
