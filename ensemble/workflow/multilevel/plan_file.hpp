// SPDX-License-Identifier: Apache-2.0
/// What was decided of a multilevel ensemble, kept so that a run that goes on decides nothing anew.
#pragma once

#include "ensemble/fidelity/multilevel/level_plan.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

/// One decision, from the members that the rounds before it had.
struct PlanRound {
  LevelPlan plan;                     ///< of level numbers below
  std::vector<std::int64_t> members;  ///< [levels] that this round brings each to
  std::vector<double> cost_s;         ///< [levels] mean CPU seconds of a member, as measured
  double budget_s = 0;                ///< that was asked for; 0: errors were
};

struct StoredPlan {
  std::vector<std::string> levels;  ///< names, the dearest first
  std::int64_t pilot = 0;           ///< members of each level before the first round
  std::vector<PlanRound> rounds;
};

/// multilevel_plan.json. \throws IoError
void write_plan(const std::filesystem::path& file, const StoredPlan&);
/// Nothing where there is no such file. \throws SetupError when it is damaged
std::optional<StoredPlan> read_plan(const std::filesystem::path& file);

}  // namespace sturz::workflow
