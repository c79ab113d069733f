// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/multilevel/plan_file.hpp"

#include "engine/core/error.hpp"
#include "io/files/text_files.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <system_error>

namespace sturz::workflow {
namespace {

using Json = nlohmann::ordered_json;

PlanRound round_of(const Json& json, std::size_t n_levels) {
  PlanRound round;
  json.at("used").get_to(round.plan.levels);
  json.at("draws").get_to(round.plan.draws);
  json.at("seconds").get_to(round.plan.seconds);
  json.at("gain").get_to(round.plan.gain);
  json.at("members").get_to(round.members);
  json.at("member_cpu_s").get_to(round.cost_s);
  json.at("budget_s").get_to(round.budget_s);
  const bool fits = !round.plan.levels.empty() && round.plan.levels.front() == 0 &&
                    round.plan.levels.size() <= most_levels &&
                    std::is_sorted(round.plan.levels.begin(), round.plan.levels.end()) &&
                    round.plan.levels.back() < n_levels &&
                    round.plan.draws.size() == round.plan.levels.size() &&
                    round.members.size() == n_levels && round.cost_s.size() == n_levels &&
                    std::all_of(round.members.begin(), round.members.end(),
                                [](std::int64_t n) { return n >= 0 && n <= 10'000'000; });
  require(fits, "a round does not fit its levels");
  return round;
}

}  // namespace

void write_plan(const std::filesystem::path& file, const StoredPlan& plan) {
  Json json{{"levels", plan.levels}, {"pilot", plan.pilot}, {"rounds", Json::array()}};
  for (const PlanRound& r : plan.rounds)
    json["rounds"].push_back({{"used", r.plan.levels},
                              {"draws", r.plan.draws},
                              {"seconds", r.plan.seconds},
                              {"gain", r.plan.gain},
                              {"members", r.members},
                              {"member_cpu_s", r.cost_s},
                              {"budget_s", r.budget_s}});
  write_text_atomic(file, json.dump(2) + "\n");
}

std::optional<StoredPlan> read_plan(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return std::nullopt;
  const std::string text = read_text(file);
  try {
    const Json json = Json::parse(text);
    StoredPlan plan;
    json.at("levels").get_to(plan.levels);
    json.at("pilot").get_to(plan.pilot);
    require(!plan.levels.empty() && plan.pilot > 0, "no levels");
    for (const Json& round : json.at("rounds"))
      plan.rounds.push_back(round_of(round, plan.levels.size()));
    return plan;
  } catch (const std::exception& problem) {
    throw SetupError(
        fmt::format("{} is damaged ({}). Remove it: the numbers of members are then "
                    "chosen anew, and no member is lost.",
                    file.string(), problem.what()));
  }
}

}  // namespace sturz::workflow
