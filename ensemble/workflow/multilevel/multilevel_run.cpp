// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/multilevel/multilevel_run.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/choice.hpp"
#include "ensemble/fidelity/multilevel/remembered_members.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/members/run_ensemble.hpp"
#include "ensemble/workflow/multilevel/decision.hpp"
#include "ensemble/workflow/without_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

constexpr int usual_pilot = 16;

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
        auto round = next_round(members(), job_.plan.rounds, target_, look_.cost_s, cancel_);
        if (!round) break;
        job_.plan.rounds.push_back(std::move(*round));
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
