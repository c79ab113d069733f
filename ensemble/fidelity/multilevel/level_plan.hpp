// SPDX-License-Identifier: Apache-2.0
/// Which levels are used, and how many draws each gets.
#pragma once

#include "ensemble/fidelity/multilevel/increments.hpp"

#include <span>
#include <string>
#include <vector>

namespace sturz {

/// One result as some levels tell it.
struct LevelResult {
  std::string name;
  std::vector<double> variances;  ///< [levels used] of the increments, the dearest first
  double plain_variance = 0;      ///< of plain sampling, for one draw
  double allowed = 0;             ///< variance that its mean may have; 0: nothing is asked of it
  double reached = nan_d;         ///< variance that its mean has by the draws that there are
};

/// Levels that may be used together.
struct LevelSet {
  std::vector<std::size_t> levels;  ///< of all, the dearest first; {0} is plain sampling
  std::vector<LevelResult> results;
};

/// Seconds that all draws together may take; 0: the results say what is enough.
struct LevelBudget {
  double seconds = 0;
  std::vector<double> spent_s = {};  ///< [levels] so far; gone where a set does not use the level
};

struct LevelPlan {
  std::vector<std::size_t> levels;  ///< that are used
  std::vector<double> draws;        ///< [levels used], whole numbers
  double seconds = 0;               ///< of all draws of the used levels
  /// Seconds of plain sampling for the same (with a budget: for the mean over the results of the
  /// variances, each over its plain one), over those of this.
  double gain = 1;
};

/// Of the sets the one of least seconds (with a budget: of least mean variance, each result's over
/// that of one plain draw). Plain sampling is kept where no set is a fifth cheaper.
/// \param sets the first is plain sampling; the same results in each
/// \param cost_s of a draw at each level
/// \param have draws that each level has already: no level gets fewer
LevelPlan plan_levels(std::span<const LevelSet> sets, std::span<const double> cost_s,
                      std::span<const double> have, const LevelBudget& budget);

/// The subsets of up to three of the levels 1 to n - 1, each behind level 0; plain sampling first.
std::vector<std::vector<std::size_t>> level_subsets(std::size_t n_levels);

}  // namespace sturz
