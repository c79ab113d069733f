// SPDX-License-Identifier: Apache-2.0
/// What `plan` and `submit` have in common.
#pragma once

#include "ensemble/app/grammar.hpp"
#include "ensemble/workflow/cluster/shard_plan.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace sturz::app {

struct PlanOptions {
  std::string scenario;
  std::vector<std::string> set;  ///< "key=value"
  int members = 0;               ///< 0: as the scenario says
  double minutes = 5;            ///< that a shard computes at least
  int cores = 0;                 ///< of a shard; 0: one, or as submitted before
  int shards = 0;                ///< 0: by the minutes
};

void add_plan_options(CLI::App& parser, PlanOptions&);
workflow::PlanRequest plan_request(const PlanOptions&);

/// Its keys stand in the user guide.
nlohmann::ordered_json plan_json(const workflow::ShardPlan&);

}  // namespace sturz::app
