// SPDX-License-Identifier: Apache-2.0
/// Into how many shards an ensemble is divided, and what to ask a scheduler for.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/workflow/forecast/forecast.hpp"
#include "ensemble/workflow/forecast/range.hpp"
#include "ensemble/workflow/scene.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz::workflow {

struct PlanRequest {
  double shard_s = 300;    ///< a shard computes at least so long: scheduling one has its price
  int cores = 1;           ///< of a shard, each with a member of its own
  int shards = 0;          ///< 0: by shard_s
  int most_shards = 1000;  ///< that an array of jobs may have
  SpeedCache speed_cache;
  double start_s = 0;  ///< what starting and reading the scene took
  CancelFlag cancel = {};
};

struct ShardPlan {
  std::int64_t members = 0;
  int shards = 1, cores = 1;
  std::int64_t least_members = 0, most_members = 0;  ///< of a shard
  Range shard_s;                                     ///< of the largest one, elapsed
  double ask_s = 0, ask_bytes = 0;                   ///< for a shard
  double maps_ask_s = 0, maps_ask_bytes = 0;         ///< for the merge
  Forecast forecast;
};

/// From a trial of the scene's members on this machine: those of the cluster may be faster or
/// slower. Asked for is half as much again as the high end of the forecast, in whole minutes, at
/// least ten: who asks for too little is stopped and goes on later, who asks for too much waits
/// longer. \throws Cancelled; SetupError for an ensemble without members
ShardPlan plan_shards(const Scene&, const PlanRequest&);

/// In sentences.
std::vector<std::string> plan_lines(const ShardPlan&);

/// "00:17:00", "2-03:00:00": as schedulers want it.
std::string time_limit_text(double seconds);
/// "400M".
std::string memory_text(double bytes);

}  // namespace sturz::workflow
