// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/cluster/shard_plan.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/readable.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sturz::workflow {
namespace {

constexpr double asked_over_high = 1.5;
constexpr double least_ask_s = 600;
constexpr double minute_s = 60, hour_s = 3600;

double ask_for_seconds(double high_s) {
  return std::max(least_ask_s, std::ceil(asked_over_high * high_s / minute_s) * minute_s);
}

double ask_for_bytes(double high_bytes) {
  constexpr double step = 100e6;
  return std::ceil(high_bytes / step) * step;
}

/// Elapsed time of so many members, side by side on so many cores [s].
double elapsed(double members, double member_s, int cores, double start_s) {
  return start_s + std::ceil(members / cores) * member_s;
}

}  // namespace

ShardPlan plan_shards(const Scene& scene, const PlanRequest& request) {
  const DesignTable design = new_design(scene.scenario);
  ShardPlan plan;
  plan.members = design.n_members();
  require(plan.members > 0,
          "the scene has no ensemble (there is nothing to divide). Give ensemble.members, or -n.");
  plan.cores = request.cores;
  ForecastRequest of;
  of.design = &design;
  of.members = plan.members;
  of.workers = request.cores;
  of.speed_cache = request.speed_cache;
  of.start_s = request.start_s;
  of.cancel = request.cancel;
  plan.forecast = forecast(scene, of);
  const Forecast& f = plan.forecast;
  const auto all = static_cast<double>(plan.members);
  const double by_time =
      std::floor(all * f.member_s.likely / request.cores / std::max(1.0, request.shard_s));
  const double most = std::min<double>(request.most_shards, all);
  plan.shards =
      static_cast<int>(std::clamp(request.shards > 0 ? request.shards : by_time, 1.0, most));
  plan.least_members = plan.members / plan.shards;
  plan.most_members = (plan.members + plan.shards - 1) / plan.shards;
  const auto largest = static_cast<double>(plan.most_members);
  plan.shard_s = {elapsed(largest, f.member_s.likely, plan.cores, f.start_s),
                  elapsed(largest, f.member_s.low, plan.cores, f.start_s),
                  elapsed(largest, f.member_s.high, plan.cores, f.start_s)};
  plan.ask_s = ask_for_seconds(plan.shard_s.high);
  plan.ask_bytes = ask_for_bytes(members_memory(scene, plan.cores).high);
  plan.maps_ask_s = f.tried_members > 0 ? ask_for_seconds(f.maps_s.high + f.start_s) : hour_s;
  plan.maps_ask_bytes = ask_for_bytes(f.memory_bytes.high);
  return plan;
}

std::vector<std::string> plan_lines(const ShardPlan& p) {
  const Forecast& f = p.forecast;
  const std::string each = p.least_members == p.most_members
                               ? std::to_string(p.most_members)
                               : fmt::format("{} or {}", p.least_members, p.most_members);
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{} members of about {} of one core: {} in all", p.members,
                              seconds_text(f.member_s), seconds_text(f.members_s)));
  lines.push_back(fmt::format("{} shard{} of {} members, {} core{} each: about {}", p.shards,
                              p.shards == 1 ? "" : "s", each, p.cores, p.cores == 1 ? "" : "s",
                              seconds_text(p.shard_s)));
  lines.push_back(fmt::format("  ask for {} and {} per shard", time_limit_text(p.ask_s),
                              memory_text(p.ask_bytes)));
  lines.push_back(fmt::format("  ask for {} and {} for the maps", time_limit_text(p.maps_ask_s),
                              memory_text(p.maps_ask_bytes)));
  if (!f.tried)
    lines.push_back(
        fmt::format("  no member could be tried{}: all of this is off by up to a "
                    "factor of four",
                    f.failure.empty() ? "" : " (" + f.failure + ")"));
  return lines;
}

std::string time_limit_text(double seconds) {
  const auto s = static_cast<long long>(std::ceil(seconds));
  const long long day = 86400, days = s / day;
  const std::string clock =
      fmt::format("{:02d}:{:02d}:{:02d}", s % day / 3600, s % 3600 / 60, s % 60);
  return days > 0 ? fmt::format("{}-{}", days, clock) : clock;
}

std::string memory_text(double bytes) { return fmt::format("{:.0f}M", std::ceil(bytes / 1e6)); }

}  // namespace sturz::workflow
