// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/multilevel/decision.hpp"

#include "engine/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace sturz::workflow {
namespace {

constexpr double most_draws = 1e6;

/// A set whose members do not let one know some result asks for nothing of it, and would look
/// cheap.
bool tells_all_of(const LevelSet& set, const LevelSet& plain) {
  return std::all_of(plain.results.begin(), plain.results.end(), [&](const LevelResult& wanted) {
    return std::any_of(set.results.begin(), set.results.end(),
                       [&](const LevelResult& r) { return r.name == wanted.name; });
  });
}

bool is_reached(const LevelMembers& all, std::span<const PlanRound> rounds,
                const TargetSpec& target, CancelFlag cancel) {
  if (rounds.empty()) return false;
  if (target.core_hours > 0)
    return 3600 * target.core_hours <= near_enough * rounds.back().budget_s;
  if (rounds.size() >= most_rounds) return true;
  const LevelSet set = level_set(all, rounds.back().plan.levels, target, cancel);
  // By the draws that tell it: members that failed, or whose end was not seen, are none.
  return std::none_of(set.results.begin(), set.results.end(), [&](const LevelResult& r) {
    return r.allowed > 0 && r.reached > near_enough * near_enough * r.allowed;
  });
}

/// Plain sampling first; after the first round it and the levels of that round.
std::vector<LevelSet> sets_to_try(const LevelMembers& all, std::span<const PlanRound> rounds,
                                  const TargetSpec& target, CancelFlag cancel) {
  std::vector<std::vector<std::size_t>> subsets = level_subsets(all.counts.size());
  if (!rounds.empty()) {
    subsets = {{0}};
    if (rounds.back().plan.levels.size() > 1) subsets.push_back(rounds.back().plan.levels);
  }
  std::vector<LevelSet> sets;
  for (std::vector<std::size_t>& subset : subsets) {
    if (shared_draws(all, subset) < least_draws) continue;
    LevelSet set = level_set(all, std::move(subset), target, cancel);
    if (sets.empty() || tells_all_of(set, sets.front())) sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace

std::optional<PlanRound> next_round(const LevelMembers& all, std::span<const PlanRound> rounds,
                                    const TargetSpec& target, std::span<const double> cost_s,
                                    CancelFlag cancel) {
  if (is_reached(all, rounds, target, cancel)) return std::nullopt;
  PlanRound round;
  round.cost_s.assign(cost_s.begin(), cost_s.end());
  round.budget_s = 3600 * target.core_hours;
  std::vector<double> have, valid_share;
  LevelBudget budget{round.budget_s, {}};
  for (std::size_t p = 0; p < all.counts.size(); ++p) {
    const auto valid =
        static_cast<double>(valid_of(all, std::vector<std::size_t>{p}).front().size());
    const auto n = static_cast<double>(all.counts[p]);
    have.push_back(valid);
    valid_share.push_back(std::max(valid, 1.0) / n);
    budget.spent_s.push_back(n * cost_s[p]);
  }
  round.plan = plan_levels(sets_to_try(all, rounds, target, cancel), cost_s, have, budget);
  round.members = all.counts;
  for (std::size_t l = 0; l < round.plan.levels.size(); ++l) {
    const std::size_t p = round.plan.levels[l];
    const double n = std::ceil(round.plan.draws[l] / valid_share[p] - 1e-9);
    require(n <= most_draws,
            fmt::format("ensemble.target (it would take {:.0f} members of {}). Ask for a larger "
                        "error.",
                        n, all.parts[p].name));
    round.members[p] = std::max(all.counts[p], static_cast<std::int64_t>(n));
  }
  if (!rounds.empty() && round.members == all.counts) return std::nullopt;
  return round;
}

}  // namespace sturz::workflow
