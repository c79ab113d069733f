// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/multilevel/multilevel_run.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/choice.hpp"
#include "ensemble/fidelity/multilevel/remembered_members.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/members/run_ensemble.hpp"
#include "ensemble/workflow/multilevel/estimates.hpp"
#include "ensemble/workflow/without_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

constexpr int usual_pilot = 16;
constexpr std::size_t most_rounds = 5;
constexpr double most_draws = 1e6;
constexpr double near_enough = 1.05;  // of a wanted error: what the next round would not be worth

fs::path plan_of(const EnsembleRequest& request) { return request.folder / "multilevel_plan.json"; }

/// Members that a begun level was last told to have.
std::int64_t begun_members(const EnsembleRequest& request, const LevelPart& part) {
  const OutputFolder folder{request.folder / "levels" / part.name};
  return holds_results(folder, "ensemble") ? Manifest::read(folder.manifest()).members : 0;
}

void require_draws(const Scene& scene) {
  const EnsembleSpec& e = scene.scenario.ensemble;
  require(e.design == Design::monte_carlo || e.design == Design::latin_hypercube ||
              e.design == Design::sobol,
          fmt::format("ensemble.estimator: multilevel with ensemble.design = {} (its levels draw "
                      "anew, and independently). Use --set ensemble.design=monte_carlo.",
                      to_string(e.design)));
  require(!uncertain_keys(scene.scenario).empty(),
          "ensemble.estimator: multilevel (no value of the scene is uncertain: one member is all "
          "there is). Use `sturz run`, or give a key a distribution.");
}

/// Levels that were not asked for may be impossible, such as too few layers of particles: they are
/// left out.
std::vector<LevelPart> possible_parts(const EnsembleRequest& request, const Scene& scene,
                                      Observer& observer) {
  std::vector<LevelPart> parts = level_parts(scene), possible{parts.front()};
  if (!scene.scenario.ensemble.levels.empty()) return parts;
  for (std::size_t p = 1; p < parts.size(); ++p) {
    try {
      load_scene(level_request(request, parts[p], scene.inputs.hazard_grid.cell_m, 1).scene);
      possible.push_back(parts[p]);
    } catch (const SetupError& problem) {
      observer.warning(fmt::format("level {} is left out: {}", parts[p].name, problem.what()));
    }
  }
  return possible;
}

/// A set whose members do not let one know some result asks for nothing of it, and would look
/// cheap.
bool tells_all_of(const LevelSet& set, const LevelSet& plain) {
  return std::all_of(plain.results.begin(), plain.results.end(), [&](const LevelResult& wanted) {
    return std::any_of(set.results.begin(), set.results.end(),
                       [&](const LevelResult& r) { return r.name == wanted.name; });
  });
}

class Levels {
 public:
  Levels(MultilevelJob& job, Observer& observer, PlanListener& listener,
         const std::atomic<bool>& cancel)
      : job_(job),
        quiet_(observer),
        listener_(listener),
        cancel_(cancel),
        target_(job.scene.scenario.ensemble.target.value_or(TargetSpec{})),
        counts_(job.parts.size(), job.plan.pilot),
        stores_(job.parts.size()),
        remembered_(job.parts.size()),
        jobs_(job.parts.size()) {}

  MultilevelMembers run() {
    compute(counts_);
    const auto valid = valid_of(members(), std::vector<std::size_t>{0}).front().size();
    require(valid >= least_draws,
            fmt::format("{} of {} members of {} are valid (at least {} are needed). See why they "
                        "fail in {}, or raise ensemble.pilot.",
                        valid, job_.plan.pilot, job_.parts.front().name, least_draws,
                        (job_.request.folder / "levels" / job_.parts.front().name).string()));
    look_at_pilot();
    for (std::size_t r = 0;; ++r) {
      if (r == job_.plan.rounds.size()) {
        if (!wants_more()) break;
        PlanRound round = decide();
        if (r > 0 && round.members == counts_) break;  // no more of them would help
        job_.plan.rounds.push_back(std::move(round));
        write_plan(plan_of(job_.request), job_.plan);
      }
      look_.rounds.push_back(job_.plan.rounds[r]);
      listener_.decided(job_, look_);
      compute(job_.plan.rounds[r].members);
    }
    MultilevelMembers all;
    for (std::size_t p = 0; p < stores_.size(); ++p) {
      all.stores.push_back(std::move(*stores_[p]));
      all.jobs.push_back(std::move(*jobs_[p]));
    }
    all.planned = counts_;
    return all;
  }

 private:
  /// The cheapest level first: it tells first what is wrong with the scene.
  void compute(const std::vector<std::int64_t>& counts) {
    for (std::size_t p = counts.size(); p-- > 0;) {
      if (stores_[p] && counts[p] <= counts_[p]) continue;
      jobs_[p].reset();  // gives the folder free
      const std::int64_t n = std::max(counts[p], begun_members(job_.request, job_.parts[p]));
      jobs_[p].emplace(prepare_level(job_.request, job_.parts[p],
                                     job_.scene.inputs.hazard_grid.cell_m, n, quiet_));
      const MembersRun run = run_ensemble(*jobs_[p], quiet_, cancel_);
      require(run.stop_error.empty(), run.stop_error);
      if (run.interrupted) throw Cancelled();
      const EnsembleJob& done = *jobs_[p];
      remembered_[p].reset();
      stores_[p].emplace(members_of(done.folder, done.manifest, done.design, {}, cancel_));
      remembered_[p].emplace(*stores_[p], remembered_bytes);
      const std::string missing = what_is_missing(*stores_[p], n);
      require(missing.empty(), fmt::format("{}: {}. The same command computes them again.",
                                           done.folder.root.string(), missing));
    }
    for (std::size_t p = 0; p < counts.size(); ++p) counts_[p] = std::max(counts_[p], counts[p]);
  }

  LevelMembers members() const {
    LevelMembers all;
    for (const auto& remembered : remembered_) all.members.push_back(&*remembered);
    all.counts = counts_;
    all.parts = job_.parts;
    return all;
  }

  /// Correlations are of the pilot, however far the folder is.
  void look_at_pilot() {
    const LevelMembers all = members();
    for (std::size_t p = 0; p < counts_.size(); ++p) look_.cost_s.push_back(member_cost_s(all, p));
    look_.results = headline_results();
    look_.results.emplace_back(map_word);
    for (const std::string& name : headline_results()) {
      auto& row = look_.squared_correlations.emplace_back();
      for (std::size_t p = 0; p < counts_.size(); ++p)
        row.push_back(p == 0 ? 1 : scalar_of(all, pair_with(p), name).squared_correlations[1]);
    }
    auto& row = look_.squared_correlations.emplace_back();
    for (std::size_t p = 0; p < counts_.size(); ++p) {
      if (p == 0) {
        row.push_back(1);
        continue;
      }
      if (shared_draws(all, pair_with(p)) < least_draws) {
        row.push_back(nan_d);
        continue;
      }
      const MultilevelMap map = map_of(all, pair_with(p), {}, cancel_);
      row.push_back(map.plain_variance > 0 ? 1 - map.variances[0] / map.plain_variance : nan_d);
    }
  }

  static std::vector<std::size_t> pair_with(std::size_t part) { return {0, part}; }

  bool wants_more() const {
    const std::vector<PlanRound>& rounds = job_.plan.rounds;
    if (rounds.empty()) return true;
    if (target_.core_hours > 0)
      return 3600 * target_.core_hours > near_enough * rounds.back().budget_s;
    if (rounds.size() >= most_rounds) return false;
    const LevelSet set = level_set(members(), rounds.back().plan.levels, target_, cancel_);
    // By the draws that tell it: members that failed, or whose end was not seen, are none.
    return std::any_of(set.results.begin(), set.results.end(), [&](const LevelResult& r) {
      return r.allowed > 0 && r.reached > near_enough * near_enough * r.allowed;
    });
  }

  PlanRound decide() const {
    const LevelMembers all = members();
    std::vector<std::vector<std::size_t>> subsets = level_subsets(counts_.size());
    if (!job_.plan.rounds.empty()) {
      subsets = {{0}};
      if (job_.plan.rounds.back().plan.levels.size() > 1)
        subsets.push_back(job_.plan.rounds.back().plan.levels);
    }
    std::vector<LevelSet> sets;
    for (std::vector<std::size_t>& subset : subsets) {
      if (shared_draws(all, subset) < least_draws) continue;
      LevelSet set = level_set(all, std::move(subset), target_, cancel_);
      if (sets.empty() || tells_all_of(set, sets.front())) sets.push_back(std::move(set));
    }
    PlanRound round;
    round.cost_s = look_.cost_s;
    round.budget_s = 3600 * target_.core_hours;
    std::vector<double> have, valid_share;
    LevelBudget budget{round.budget_s, {}};
    for (std::size_t p = 0; p < counts_.size(); ++p) {
      const auto valid =
          static_cast<double>(valid_of(all, std::vector<std::size_t>{p}).front().size());
      const auto n = static_cast<double>(counts_[p]);
      have.push_back(valid);
      valid_share.push_back(std::max(valid, 1.0) / n);
      budget.spent_s.push_back(n * round.cost_s[p]);
    }
    round.plan = plan_levels(sets, round.cost_s, have, budget);
    round.members = counts_;
    for (std::size_t l = 0; l < round.plan.levels.size(); ++l) {
      const std::size_t p = round.plan.levels[l];
      const double n = std::ceil(round.plan.draws[l] / valid_share[p] - 1e-9);
      require(n <= most_draws,
              fmt::format("ensemble.target (it would take {:.0f} members of {}). Ask for a larger "
                          "error.",
                          n, job_.parts[p].name));
      round.members[p] = std::max(counts_[p], static_cast<std::int64_t>(n));
    }
    return round;
  }

  MultilevelJob& job_;
  WithoutFolder quiet_;
  PlanListener& listener_;
  const std::atomic<bool>& cancel_;
  const TargetSpec target_;
  std::vector<std::int64_t> counts_;
  std::vector<std::optional<MemberStore>> stores_;
  std::vector<std::optional<RememberedMembers>> remembered_;  // of the stores
  std::vector<std::optional<EnsembleJob>> jobs_;
  MultilevelLook look_;
};

}  // namespace

bool is_multilevel(const SceneRequest& request) {
  return read_scenario(request.file, request.overrides).ensemble.estimator == Estimator::multilevel;
}

MultilevelJob prepare_multilevel(const EnsembleRequest& request, Observer& observer) {
  MultilevelJob job;
  job.request = request;
  job.scene = load_scene(scene_of(request));
  require_draws(job.scene);
  job.parts = possible_parts(request, job.scene, observer);
  const OutputFolder folder{request.folder};
  require(!fs::exists(folder.manifest()),
          fmt::format("{} holds results of another kind. Choose another folder with --out.",
                      request.folder.string()));
  const int pilot = job.scene.scenario.ensemble.pilot.value_or(usual_pilot);
  if (auto stored = read_plan(plan_of(request))) {
    job.plan = std::move(*stored);
    std::vector<std::string> names;
    for (const LevelPart& part : job.parts) names.push_back(part.name);
    require(job.plan.levels == names && job.plan.pilot == pilot,
            fmt::format("{} was begun with levels {} and a pilot of {}. Give the same, or choose "
                        "another folder with --out.",
                        request.folder.string(), fmt::join(job.plan.levels, ", "), job.plan.pilot));
  } else {
    job.plan.pilot = pilot;
    for (const LevelPart& part : job.parts) job.plan.levels.push_back(part.name);
  }
  // Begins every level once, so that what is wrong with one is found before anything is computed.
  WithoutFolder quiet(observer);
  for (const LevelPart& part : job.parts)
    prepare_level(request, part, job.scene.inputs.hazard_grid.cell_m,
                  std::max<std::int64_t>(pilot, begun_members(request, part)), quiet);
  return job;
}

MultilevelMembers run_multilevel(MultilevelJob& job, Observer& observer, PlanListener& listener,
                                 const std::atomic<bool>& cancel) {
  return Levels(job, observer, listener, cancel).run();
}

}  // namespace sturz::workflow
