// SPDX-License-Identifier: Apache-2.0
/// What cheap members would save: the gain of an estimate that corrects many of them by few dear
/// ones.
///
/// Multifidelity Monte Carlo (Peherstorfer, Willcox and Gunzburger 2016, SIAM J. Sci. Comput. 38,
/// A3163-A3194): the mean of the dearest level, with nested samples of cheaper ones as control
/// variates. With correlations rho_i of level i with the dearest one (rho_1 = 1, falling,
/// rho_{k+1} = 0) and costs w_i, the variance for one second is sigma^2 (sum sqrt(w_i (rho_i^2 -
/// rho_{i+1}^2)))^2 instead of sigma^2 w_1, with members in the ratio sqrt(w_1 (rho_i^2 -
/// rho_{i+1}^2) / (w_i (1 - rho_2^2))) (their Eqs. 3.11 and 3.13).
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/fidelity/ladder.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sturz {

/// One result of the same members at every level, the dearest level first. A map is one result:
/// `values` holds then each cell's, and one coefficient serves all cells.
struct LevelValues {
  std::string name;
  std::vector<std::vector<double>> values;  ///< [n_levels][n_members * n_cells], cell by cell
  std::size_t n_cells = 1;
};

/// Squared correlation of a level with the first: of the sums over cells of covariance and
/// variances. 0 where one of them does not vary.
double squared_correlation(const LevelValues&, std::size_t level);

struct MultilevelGain {
  std::vector<std::size_t> levels;  ///< that are used, the first among them; in order of use
  std::vector<double> members;      ///< [levels] per member of the first level
  double gain = 1;   ///< seconds of plain sampling over those of this, for the same variance
  Interval gain_90;  ///< by drawing the members anew, for the same levels
  std::vector<double> gains;  ///< [n_results] of each result with these members
};

/// The set of levels with the largest gain in the mean over the results of their variances, each
/// over that of plain sampling. \param cost_s seconds of a member, [n_levels], at most eight
/// \param seed of resampling
MultilevelGain multilevel_gain(std::span<const LevelValues> results, std::span<const double> cost_s,
                               std::uint64_t seed);

}  // namespace sturz
