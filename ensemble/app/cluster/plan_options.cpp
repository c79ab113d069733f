// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/cluster/plan_options.hpp"

#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/forecast_json.hpp"
#include "ensemble/app/speed_cache.hpp"

#include <algorithm>

namespace sturz::app {

void add_plan_options(CLI::App& parser, PlanOptions& options) {
  add_scenario(parser, options.scenario, options.set);
  parser
      .add_option("-n,--members", options.members, "Number of members, instead of the scenario's")
      ->check(CLI::Range(1, 100000000));
  parser
      .add_option("--minutes-per-shard", options.minutes,
                  "A shard computes at least so long (default 5): scheduling each has its price")
      ->type_name("MINUTES")
      ->check(CLI::Range(0.01, 100000.0));
  parser.add_option("--shards", options.shards, "Number of shards, instead of that")
      ->check(CLI::Range(1, 1000000));
  parser
      .add_option("--cores-per-shard", options.cores, "Members at a time in each shard (default 1)")
      ->check(CLI::Range(1, 4096));
}

workflow::PlanRequest plan_request(const PlanOptions& options) {
  workflow::PlanRequest request;
  request.shard_s = 60 * options.minutes;
  request.cores = std::max(1, options.cores);
  request.shards = options.shards;
  request.speed_cache = speed_cache();
  request.start_s = process_seconds();
  request.cancel = interrupt_flag();
  return request;
}

nlohmann::ordered_json plan_json(const workflow::ShardPlan& p) {
  return {{"members", p.members},
          {"shards", p.shards},
          {"cores_per_shard", p.cores},
          {"members_per_shard", {{"least", p.least_members}, {"most", p.most_members}}},
          {"shard_elapsed_s",
           {{"likely", p.shard_s.likely}, {"low", p.shard_s.low}, {"high", p.shard_s.high}}},
          {"shard_ask", {{"time_s", p.ask_s}, {"memory_bytes", p.ask_bytes}}},
          {"maps_ask", {{"time_s", p.maps_ask_s}, {"memory_bytes", p.maps_ask_bytes}}},
          {"forecast", forecast_json(p.forecast)}};
}

}  // namespace sturz::app
