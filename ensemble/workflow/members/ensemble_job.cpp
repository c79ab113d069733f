// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/ensemble_job.hpp"

#include "engine/core/error.hpp"
#include "ensemble/members/shards.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/input_check.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/members/ensemble_warnings.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"

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

/// Keeps what the folder knows of its past, and says what may surprise.
void continue_folder(EnsembleJob& job, Observer& observer) {
  require_same_scene(job.folder, job.scene.scenario, job.scene.inputs.identities);
  const Manifest before = Manifest::read(job.folder.manifest());
  job.design = continued_design(job.folder, before, job.scene.scenario, job.design);
  Manifest& now = job.manifest;
  now.design_hash_before = design_hash(saved_design(job.folder, before, job.scene.scenario));
  now.started = before.started;
  now.inputs = with_known_parts(now.inputs, before.inputs);
  now.compute_s = before.compute_s;
  if (!before.scene_hash.empty()) now.scene_hash = before.scene_hash;  // nothing differs
  now.hazard_hash = before.hazard_hash;
  now.maps_of = before.maps_of;
  now.builds = before.builds;
  if (now.builds.empty()) now.builds.push_back({before.version, before.git_commit});
  const Build mine = this_build();
  if (std::find(now.builds.begin(), now.builds.end(), mine) != now.builds.end()) return;
  observer.warning(fmt::format(
      "{} was begun by {}, this is {}: members of both will stand side by side, and their results "
      "may differ. manifest.json names both. To have all members from this program, choose another "
      "folder with --out.",
      job.folder.root.string(), build_text(now.builds.back()), build_text(mine)));
  now.builds.push_back(mine);
}

/// Order matters. The manifest comes before the design, whose hash it holds, old and new: killed in
/// between, the folder can still tell it from an edited one. scenario.yaml comes last and marks the
/// folder as begun.
void begin_folder(const EnsembleJob& job) {
  Manifest manifest = job.manifest;
  make_folder(job.folder.root);
  manifest.write(job.folder.manifest());
  write_text_atomic(job.folder.design(), to_csv(job.design));
  save_scenario(job.folder, job.scene.scenario);
}

/// Members of this call's share that are not finished.
void find_work(EnsembleJob& job, const Shard& shard, bool retry_failed, Observer& observer) {
  const MemberStore store = members_of(job.folder, job.manifest, job.design, [&](std::int64_t k) {
    return k < job.design.n_members() && k % shard.n == shard.k - 1;
  });
  warn_of_problems(store, "It is computed again.", observer);
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
  const auto memory = static_cast<double>(job.scene.description.memory_bytes);
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

void keep_what_is_read(EnsembleJob& job) {
  const auto lock = job.lock;
  const auto keep = [folder = job.folder, scenario = job.scene.scenario,
                     lock](const std::vector<InputIdentity>& read) {
    lock->others_wait(folder);
    try {
      Manifest manifest = Manifest::read(folder.manifest());  // another shard may have read more
      const auto changed = changed_inputs(scenario, read, manifest.inputs);
      require(changed.empty(), "another shard has read another input:" + as_lines(changed) + "\n");
      manifest.inputs = with_known_parts(manifest.inputs, read);
      manifest.write(folder.manifest());
    } catch (...) {
      lock->others_may_come();
      throw;
    }
    lock->others_may_come();
  };
  job.scene.ground->remember(job.manifest.inputs, keep);
}

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
  job.manifest.scenario_hash = scenario_hash(job.scene.scenario);
  job.manifest.scene_hash = scene_hash(job.scene.scenario, job.scene.inputs.identities);

  holds_results(job.folder, "ensemble");  // refuses what is not ours before a lock is put there
  job.lock = shard.n > 1 ? FolderLock::shard(job.folder, shard, request.command)
                         : FolderLock::alone(job.folder, request.command);
  if (holds_results(job.folder, "ensemble"))
    continue_folder(job, observer);
  else
    job.manifest.builds = {this_build()};
  job.manifest.members = job.design.n_members();
  job.manifest.design_hash = design_hash(job.design);
  begin_folder(job);
  keep_what_is_read(job);
  job.lock->others_may_come();
  observer.folder_ready(job.folder);
  find_work(job, shard, request.retry_failed, observer);
  share_machine(job, request.workers, observer);
  return job;
}

}  // namespace sturz::workflow
