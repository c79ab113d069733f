// SPDX-License-Identifier: Apache-2.0
/// How finely to compute: the cheapest spacing for a wanted error, and how to split seconds between
/// spacing and members.
#pragma once

#include "ensemble/fidelity/ladder.hpp"

#include <span>
#include <string>
#include <vector>

namespace sturz {

/// Relative error of one member at one spacing, expected (root mean square over the members).
struct ErrorAt {
  double error = nan_d;  ///< the largest of those asked for; NaN: one of them is not known
  std::string of;        ///< which one; empty: none was asked for
};
/// "map" among `what` stands for the map of the least threshold.
inline constexpr const char* map_word = "map";
/// \param what names of results, and `map`; those that the ladder does not have are left out
ErrorAt error_at(const LadderAccuracy&, std::span<const std::string> what, double spacing_m);

struct Choice {
  double spacing_m = nan_d;  ///< within the computed spacings; NaN: none is fine enough
  double member_cpu_s = nan_d;
  ErrorAt predicted;               ///< at that spacing, or at the finest one
  bool coarsest = false;           ///< the coarsest is enough: a coarser one may be too
  double finer_spacing_m = nan_d;  ///< where none is enough: what the estimate asks for,
                                   ///< extrapolated; NaN: less than an eighth of the finest
};

/// The coarsest spacing between those that were computed, to a hundredth of their range, from which
/// on all of `what` is within `wanted` of its limit.
Choice cheapest_for(const LadderAccuracy&, std::span<const std::string> what, double wanted);

/// What a number of core-seconds buys best.
struct Split {
  double spacing_m = nan_d;  ///< within the computed spacings
  double members = nan_d;
  double error = nan_d;  ///< root mean square over the results of both parts, relative
  double resolution = nan_d, sampling = nan_d;  ///< its parts
  std::vector<std::string> of;                  ///< the results that it is over
  /// The best of all lies at an end of what was computed: beyond it may be better.
  bool coarsest = false, finest = false;
};

/// Least root mean square, over results with a scale, of the error of the mean at that spacing
/// and the standard error of so many independent members (quasi-random designs do better).
/// \param core_s computing time for all members together; at least two members fit, or the split is
/// NaN
/// \param what names of results; those that the ladder does not have are left out; empty: all
Split best_split(const LadderAccuracy&, double core_s, std::span<const std::string> what = {});

/// The same at a given spacing, for comparison.
Split split_at(const LadderAccuracy&, double core_s, double spacing_m,
               std::span<const std::string> what = {});

}  // namespace sturz
