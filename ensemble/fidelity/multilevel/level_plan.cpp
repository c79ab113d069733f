// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/level_plan.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr double worth_it = 1.2;  // plain seconds over those of a set

/// Mean over the results of what each level leaves of the plain variance.
std::vector<double> mean_shares(const LevelSet& set) {
  std::vector<double> mean(set.levels.size(), 0);
  double n = 0;
  for (const LevelResult& r : set.results) {
    if (!(r.plain_variance > 0)) continue;
    n += 1;
    for (std::size_t l = 0; l < mean.size(); ++l) mean[l] += r.variances[l] / r.plain_variance;
  }
  for (double& m : mean) m /= std::max(n, 1.0);
  return mean;
}

/// Draws that serve every result that something is asked of.
std::vector<double> draws_for(const LevelSet& set, std::span<const double> costs, double seconds) {
  if (seconds > 0) return allocate_for_cost(mean_shares(set), costs, seconds).draws;
  std::vector<double> draws(set.levels.size(), 0);
  for (const LevelResult& r : set.results) {
    if (!(r.allowed > 0)) continue;
    const Allocation a = allocate_for_variance(r.variances, costs, r.allowed);
    for (std::size_t l = 0; l < draws.size(); ++l) draws[l] = std::max(draws[l], a.draws[l]);
  }
  return draws;
}

/// Seconds that a set's own levels may take together, what they took included; 0: no budget.
double left_for(const LevelSet& set, const LevelBudget& budget) {
  if (!(budget.seconds > 0)) return 0;
  double left = budget.seconds;
  for (std::size_t l = 0; l < budget.spent_s.size(); ++l)
    if (std::find(set.levels.begin(), set.levels.end(), l) == set.levels.end())
      left -= budget.spent_s[l];
  return std::max(left, 1e-3);
}

struct Candidate {
  LevelPlan plan;
  double worth = 0;  ///< what is least for the best: seconds, or variance under a budget
};

Candidate candidate_of(const LevelSet& set, std::span<const double> cost_s,
                       std::span<const double> have, double seconds) {
  std::vector<double> costs;
  for (const std::size_t l : set.levels) costs.push_back(cost_s[l]);
  Candidate c;
  c.plan.levels = set.levels;
  c.plan.draws = draws_for(set, costs, seconds);
  double before = 0;
  const std::vector<double> shares = mean_shares(set);
  double variance = 0;
  for (std::size_t l = 0; l < set.levels.size(); ++l) {
    double& n = c.plan.draws[l];
    // A budget is not to be passed: whole draws from below.
    n = seconds > 0 ? std::floor(n) : std::ceil(n);
    n = std::max({n, have[set.levels[l]], before});
    before = n;
    c.plan.seconds += n * costs[l];
    variance += shares[l] / n;
  }
  c.worth = seconds > 0 ? variance : c.plan.seconds;
  return c;
}

}  // namespace

LevelPlan plan_levels(std::span<const LevelSet> sets, std::span<const double> cost_s,
                      std::span<const double> have, const LevelBudget& budget) {
  expect(!sets.empty() && sets.front().levels.size() == 1, "plain sampling first");
  const Candidate plain = candidate_of(sets.front(), cost_s, have, left_for(sets.front(), budget));
  Candidate best = plain;
  double least = plain.worth / worth_it;
  for (const LevelSet& set : sets.subspan(1)) {
    const Candidate c = candidate_of(set, cost_s, have, left_for(set, budget));
    if (!(c.worth < least)) continue;
    least = c.worth;
    best = c;
  }
  // Of nothing that varies there is nothing to gain.
  best.plan.gain = best.worth > 0 ? plain.worth / best.worth : 1;
  return best.plan;
}

std::vector<std::vector<std::size_t>> level_subsets(std::size_t n_levels) {
  std::vector<std::vector<std::size_t>> all;
  for (unsigned set = 0; set < 1U << (n_levels - 1); ++set) {
    std::vector<std::size_t> levels{0};
    for (std::size_t l = 1; l < n_levels; ++l)
      if ((set >> (l - 1) & 1U) != 0) levels.push_back(l);
    if (levels.size() <= most_levels) all.push_back(std::move(levels));
  }
  return all;
}

}  // namespace sturz
