// SPDX-License-Identifier: Apache-2.0
/// The levels of a multilevel ensemble: the scene itself, and cheaper ways to compute it.
#pragma once

#include "ensemble/workflow/members/ensemble_job.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz::workflow {

/// One way to compute the scene; its members are an ordinary ensemble of independent draws.
struct LevelPart {
  std::string name;         ///< of its folder: "full_stress_6m"
  std::string formulation;  ///< in words of the scenario
  double spacing_m = 0;
};

/// The scene's own level first, then those of ensemble.levels, or, where none are given: the same
/// formulation at twice the spacing, and columns at one and a half and at three times it where the
/// scene itself is computed in full stress, at twice and at three times where it is columns.
/// \throws SetupError for levels that no scene can have, and those that are not cheaper
std::vector<LevelPart> level_parts(const Scene&);

/// An ensemble of so many members at a level, in folder/levels/NAME: independent draws, the same
/// ones at every level, on one grid of maps.
EnsembleRequest level_request(const EnsembleRequest&, const LevelPart&, double cell_m,
                              std::int64_t members);

/// Without the keys of the estimator: what a member is does not depend on what is made of it.
void forget_estimator(Scenario&);

/// Prepares one level's ensemble. \throws SetupError naming the level
EnsembleJob prepare_level(const EnsembleRequest&, const LevelPart&, double cell_m,
                          std::int64_t members, Observer&);

}  // namespace sturz::workflow
