// SPDX-License-Identifier: Apache-2.0
/// Numbers of the same draws at several levels, and what they tell of the dearest one: mean,
/// distribution, quantiles.
#pragma once

#include "ensemble/fidelity/multilevel/margin_model.hpp"
#include "ensemble/fidelity/valid_members.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sturz {

/// One draw: its number, and the dearest level from which on all have it.
struct LevelDraw {
  std::int64_t number = 0;
  std::size_t from = 0;
  Margins values{};  ///< [level], from `from` on
};

/// Draws that the cheapest level has, ascending. \param levels valid members, the dearest first
std::vector<LevelDraw> level_draws(std::span<const ByNumber> levels);
/// The same of one result, where each level's member lets one know it.
std::vector<LevelDraw> level_draws(std::span<const ByNumber> levels, double MemberScalars::*field);
/// Draws of each level. \return [n_levels]
std::vector<std::size_t> draws_of_levels(std::span<const LevelDraw>, std::size_t n_levels);
/// So few draws at the dearest level tell nothing of the others.
inline constexpr std::size_t least_draws = 6;

struct QuantileEstimate {
  double level = nan_d, value = nan_d;
  Interval bounds_90;  ///< infinite where the draws do not tell it
  /// Of the dearest level, at least, before both bounds can be told; 0 where they are.
  std::size_t draws_needed = 0;
};

/// One result of all members.
struct MultilevelScalar {
  MultilevelMean mean;
  std::vector<double> draws;      ///< [n_levels]
  std::vector<double> variances;  ///< [n_levels] of the increments
  /// The same and one standard error of each: numbers of draws that follow from them, and do not
  /// end where few draws happen to scatter little.
  std::vector<double> cautious_variances;
  double variance = nan_d;                   ///< of the result itself: what plain sampling has
  std::vector<double> squared_correlations;  ///< [n_levels] with the dearest, [0] = 1
};
/// Linear predictions. Everything is NaN with fewer than least_draws at the dearest level.
MultilevelScalar multilevel_scalar(std::span<const LevelDraw>, std::size_t n_levels);

/// Through the estimated distribution function, as the nearest rising one in the mean square; its
/// bounds are those of the distribution function (share_bounds()), read the other way. A bound is
/// infinite where the draws do not tell one: fewer than 59 have no upper bound of what 5 % exceed.
/// \param levels rising, within 0 and 1
std::vector<QuantileEstimate> multilevel_quantiles(std::span<const LevelDraw>, std::size_t n_levels,
                                                   std::span<const double> levels);

/// A probability with 90 % bounds; NaN where nothing is known.
struct ShareEstimate {
  double share = nan_d;
  Interval bounds_90;
};
/// P(result > threshold), and its bounds as those of maps and of the distribution function
/// (share_bounds(), of one level Wilson's): nowhere nearer to 0 and 1 than unseen_share(). Unbiased
/// before it is held within 0 and 1, whatever the cheaper levels tell. NaN with fewer than
/// least_draws at the dearest of several levels, and without any.
ShareEstimate multilevel_share_above(std::span<const LevelDraw>, std::size_t n_levels,
                                     double threshold);

/// The nearest rising function in the mean square, within 0 and 1. The running maximum would lie
/// above.
void make_rising(std::vector<double>&);

}  // namespace sturz
