// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/ensemble_job.hpp"

#include "engine/core/error.hpp"
#include "ensemble/members/shards.hpp"
#include "ensemble/workflow/cost_warnings.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/members/ensemble_warnings.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"
#include "io/members/member_store.hpp"
#include "io/scenario/scenario_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

namespace sturz::workflow {
namespace {

/// The wanted number of members is the last override.
SceneRequest scene_of(const EnsembleRequest& request) {
  SceneRequest scene = request.scene;
  if (request.members > 0)
    scene.overrides.push_back(fmt::format("ensemble.members={}", request.members));
  return scene;
}

/// Refuses to go on in a folder that was begun with another scene or other files.
void require_same_scene(const OutputFolder& folder, const Scene& scene) {
  std::string what;
  for (const std::string& line : differences(read_scenario(folder.scenario()), scene.scenario))
    what += "\n  " + line;
  for (const std::string& line :
       input_differences(Manifest::read(folder.manifest()).inputs, scene.inputs.identities))
    what += "\n  " + line;
  require(what.empty(),
          fmt::format("{} was begun with another scene (members of two scenes make no map). "
                      "Choose another folder with --out, or take these changes back:{}",
                      folder.root.string(), what));
}

/// Order matters: scenario.yaml comes last and marks the folder as begun.
void begin_folder(const EnsembleJob& job) {
  Manifest manifest = job.manifest;
  make_folder(job.folder.root);
  write_text_atomic(job.folder.design(), to_csv(job.design));
  manifest.write(job.folder.manifest());
  save_scenario(job.folder, job.scene.scenario);
}

/// Members of this call's share that are not finished.
void find_work(EnsembleJob& job, const Shard& shard, bool retry_failed, Observer& observer) {
  const MemberStore store(job.folder.members());
  for (const std::string& problem : store.problems())
    observer.warning(problem + " It is computed again.");
  std::set<std::int64_t> finished;
  for (const MemberSummary& m : store.members())
    if (is_valid(m.outcome) || !retry_failed) finished.insert(m.member);
  for (const std::int64_t k : shard_members(job.design.n_members(), shard.k, shard.n)) {
    if (finished.contains(k))
      ++job.finished_before;
    else
      job.to_do.push_back(k);
  }
}

/// Workers times threads never exceeds the cores, nor workers times memory the machine.
void share_machine(EnsembleJob& job, int wanted_workers, Observer& observer) {
  const int cores = available_cores();
  const auto n = static_cast<int>(std::clamp<std::size_t>(job.to_do.size(), 1, 1 << 20));
  if (wanted_workers > cores)
    observer.warning(
        fmt::format("--workers {} on {} cores: {} members at a time, more would only wait for each "
                    "other.",
                    wanted_workers, cores, cores));
  job.workers = std::min({wanted_workers > 0 ? wanted_workers : cores, cores, n});
  const double memory = static_cast<double>(job.scene.description.memory_bytes);
  const double free = available_memory_bytes();
  if (memory > 0 && free > 0 && memory * job.workers > 0.9 * free) {
    const int fewer = std::max(1, static_cast<int>(0.9 * free / memory));
    if (fewer < job.workers) {
      observer.warning(
          fmt::format("{} members at a time instead of {}: each needs {:.0f} MB and {:.0f} "
                      "MB are free.",
                      fewer, job.workers, memory / 1e6, free / 1e6));
      job.workers = fewer;
    }
  }
  job.threads = std::max(1, cores / job.workers);
}

}  // namespace

EnsembleJob prepare_ensemble(const EnsembleRequest& request, Observer& observer) {
  const Shard shard = request.shard;
  require(shard.k >= 1 && shard.k <= shard.n,
          fmt::format("shard {}/{} (must be k/n with 1 <= k <= n).", shard.k, shard.n));
  EnsembleJob job;
  job.scene = load_scene(scene_of(request));
  job.design = new_design(job.scene.scenario);
  // With a user's table the number of rows is the number of members.
  job.scene.scenario.ensemble.members = static_cast<int>(job.design.n_members());
  job.folder.root = request.folder;
  for (std::string& warning : ensemble_warnings(job.scene, job.design))
    job.scene.description.warnings.push_back(std::move(warning));
  job.manifest = manifest_of(job.scene, "ensemble", request.command);

  if (holds_results(job.folder, "ensemble")) {
    require_same_scene(job.folder, job.scene);
    job.design = continued_design(job.folder, job.design);
    const Manifest before = Manifest::read(job.folder.manifest());
    job.manifest.started = before.started;
    job.manifest.inputs = with_known_parts(job.manifest.inputs, before.inputs);
    job.manifest.compute_s = before.compute_s;
  }
  job.manifest.members = job.design.n_members();
  begin_folder(job);
  observer.folder_ready(job.folder);
  find_work(job, shard, request.retry_failed, observer);
  share_machine(job, request.workers, observer);
  const auto to_do = static_cast<std::int64_t>(job.to_do.size());
  for (const std::string& warning : cost_warnings(job.scene, to_do, job.workers * job.threads))
    observer.warning(warning);
  return job;
}

}  // namespace sturz::workflow
