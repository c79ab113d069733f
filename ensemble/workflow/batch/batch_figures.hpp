// SPDX-License-Identifier: Apache-2.0
/// The numbers of a finished folder that stand in the summary of a batch.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/terrain/raster.hpp"
#include "ensemble/workflow/observer.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sturz::workflow {

/// Probabilities whose areas and outlines are told; 0: reached by any member.
inline constexpr std::array<double, 3> outline_levels{0, 0.1, 0.5};
/// "any", "0.1", "0.5"
std::string level_text(double level);

struct AssetChance {
  std::string name;
  double probability = nan_d;  ///< NaN: not known
};

struct BatchFigures {
  std::int64_t planned = 0, finished = 0, valid = 0, censored = 0;
  /// At 5, 50 and 95 % of the valid members; NaN: cannot be told.
  std::array<double, 3> runout_m{nan_d, nan_d, nan_d};
  std::array<bool, 3> at_least{};                      ///< the quantile lies beyond what was seen
  std::array<double, 3> area_m2{nan_d, nan_d, nan_d};  ///< at outline_levels
  std::vector<AssetChance> assets;                     ///< in the order of the scene
  double core_s = 0;  ///< computing time of all members, whenever they were computed
  std::string hazard_hash;

  std::int64_t failed() const { return finished - valid; }
};

/// Of a finished ensemble or single run. A function of what the folder holds.
/// \throws SetupError when it cannot be read; Cancelled
BatchFigures figures_of(const std::filesystem::path& folder, Observer&, CancelFlag cancel = {});

/// P(reached) on the cells of the maps, NaN where nothing is known; 1 where a single run came.
Raster<float> reached_map(const std::filesystem::path& folder);
/// Its cells that are reached with at least that probability.
Raster<std::uint8_t> cells_reached(const Raster<float>& probability, double level);

}  // namespace sturz::workflow
