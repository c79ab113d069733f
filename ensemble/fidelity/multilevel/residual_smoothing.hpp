// SPDX-License-Identifier: Apache-2.0
/// What few members correct of a map, taken over some cells around where that lowers the risk.
#pragma once

#include "engine/terrain/raster.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

struct SmoothedCorrection {
  int radius = 0;                  ///< cells to each side
  std::vector<double> mean;        ///< [n_cells]
  std::vector<double> variance;    ///< [n_cells] of one member's smoothed residual
  std::vector<double> covariance;  ///< [n_cells] of that with the member's `others`
  double bias_squared = 0;  ///< mean over the cells that count of what smoothing shifts, estimated
  double variance_ratio = 1;  ///< of the smoothed residuals to the others, over those cells
};

/// Of the radii 0 to `most` the one with the least unbiased estimate of the risk over the cells
/// that count (Stein 1981): |S r - r|^2 - Var(S r - r) + Var(S r), with variances from the members.
/// \param residuals [n_members][n_cells] in the cells `places` of the grid; 0 elsewhere
/// \param others [n_members][n_cells] what else of these members the estimate has; may be empty
/// \param counts [n_cells] whether a cell's risk counts
SmoothedCorrection smoothed_correction(const std::vector<std::vector<float>>& residuals,
                                       const std::vector<std::vector<float>>& others,
                                       const std::vector<std::size_t>& places, const Grid& grid,
                                       const std::vector<std::uint8_t>& counts, int most);

}  // namespace sturz
