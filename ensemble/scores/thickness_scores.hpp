// SPDX-License-Identifier: Apache-2.0
/// How a simulated deposit's thickness agrees with a measured one.
#pragma once

#include "engine/terrain/raster.hpp"

#include <span>

namespace sturz {

/// One cell that was measured.
struct ThicknessPair {
  double observed_m = 0, simulated_m = 0;
  double distance_m = 0;  ///< down the path, for the bands
};

struct ThicknessScores {
  // Over the cells where either is thicker than the threshold (deeper, of a net change); NaN
  // without such cells.
  double rmse_m = nan_d, bias_m = nan_d;  ///< bias: simulated less observed, mean
  double within = nan_d;                  ///< share that differs by no more than the tolerance
  // Over all measured cells.
  double volume_ratio = nan_d;  ///< simulated over observed volume
  /// Volume that lies in the same band of distance in both, over the larger of the two volumes:
  /// ten bands of equal width over the distances of the observed deposit, and what lies before and
  /// beyond; thicknesses below 0 count as none.
  double band_overlap = nan_d;
};

ThicknessScores thickness_scores(std::span<const ThicknessPair> measured, double threshold_m,
                                 double tolerance_m);

}  // namespace sturz
