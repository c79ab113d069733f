// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/ensemble_job.hpp"

#include "engine/core/error.hpp"
#include "ensemble/members/shards.hpp"
#include "ensemble/stopping/stop_rule.hpp"
#include "ensemble/workflow/calibration/calibrate.hpp"
#include "ensemble/workflow/calibration/posterior_files.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/input_check.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/members/ensemble_warnings.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"
#include "io/scenario/scenario_file.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <utility>

namespace sturz::workflow {
namespace {

/// Keeps what the folder knows of its past, and says what may surprise.
void continue_folder(EnsembleJob& job, Observer& observer) {
  require_same_scene(job.folder, job.scene.scenario, job.scene.inputs.identities);
  const Manifest before = Manifest::read(job.folder.manifest());
  job.design = continued_design(job.folder, before, job.scene.scenario, job.design);
  Manifest& now = job.manifest;
  now.design_hash_before = design_hash(saved_design(job.folder, before, job.scene.scenario));
  now.inputs = with_known_parts(now.inputs, before.inputs);
  if (!before.scene_hash.empty()) now.scene_hash = before.scene_hash;  // nothing differs
  if (!job.growth && before.members == job.design.n_members()) now.stop = before.stop;
  take_past(now, before, job.folder, observer);
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

/// A thousand shards may begin at once, one after the other: what stands there is not written
/// again.
bool stands_there(const EnsembleJob& job) {
  const Manifest before = Manifest::read(job.folder.manifest());
  const Manifest& now = job.manifest;
  return before.shards == now.shards && before.members == now.members &&
         before.inputs == now.inputs && before.builds == now.builds &&
         before.scene_hash == now.scene_hash && before.design_hash == now.design_hash &&
         read_text(job.folder.scenario()) == write_scenario(job.scene.scenario, job.folder.root);
}

/// Members of this call's share that are not finished. \param from the first that is looked at
/// \return how many of them failed before
std::size_t find_work(EnsembleJob& job, const Shard& shard, std::int64_t from, Observer& observer) {
  const auto is_mine = [&](std::int64_t k) {
    return k >= from && k < job.design.n_members() && k % shard.n == shard.k - 1;
  };
  const MemberStore store =
      members_of(job.folder, job.manifest, job.design, is_mine, {}, {shard.k, shard.n});
  warn_of_problems(store, "It is computed again.", observer);
  std::set<std::int64_t> finished;
  std::size_t again = 0;
  for (const MemberSummary& m : store.members())
    if (is_valid(m.outcome) || !job.retry_failed)
      finished.insert(m.member);
    else
      ++again;
  for (const std::int64_t k : shard_members(job.design.n_members(), shard.k, shard.n)) {
    if (k < from) continue;
    if (finished.contains(k))
      ++job.finished_before;
    else
      job.to_do.push_back(k);
  }
  return again;
}

/// A design that cannot be looked at before its end, or by one who does not see all of it.
void require_growing(const Scenario& scenario, const Shard& shard) {
  require(shard.n == 1,
          "--until-converged with --shard (a look needs all of the first members, and a shard sees "
          "every n-th: each would stop elsewhere). Run the ensemble in one folder without shards, "
          "or give their number with -n.");
  const Design design = scenario.ensemble.design;
  const bool grows =
      design == Design::sobol || design == Design::monte_carlo || design == Design::table;
  require(grows, fmt::format("--until-converged with ensemble.design = {} ({}). Use sobol or "
                             "monte_carlo, for instance with --set ensemble.design=sobol.",
                             to_string(design),
                             design == Design::latin_hypercube
                                 ? "it is drawn for a fixed number of members, and the first of "
                                   "them are no even sample"
                                 : "its members stand in sets and are no sample of what may "
                                   "happen"));
}

/// The asset that a stop rule looks at.
Asset asset_named(const std::shared_ptr<const Assets>& assets, const std::string& name) {
  require(assets != nullptr,
          fmt::format("--asset {} (the scene has no `assets`). Add them to the scene.", name));
  std::vector<std::string> names;
  for (const Asset& a : assets->list) names.push_back(a.name);
  const auto found = std::find(names.begin(), names.end(), name);
  const std::string near = nearest_name(name, names);
  require(found != names.end(),
          fmt::format("--asset {} (no asset has that name{}). Names are those of "
                      "assets.name_attribute.",
                      name, near.empty() ? "" : fmt::format("; did you mean {}?", near)));
  const Asset& asset = assets->list[static_cast<std::size_t>(found - names.begin())];
  require(asset.place() != AssetPlace::outside,
          fmt::format("--asset {} (it lies beyond the known ground: nothing will be known of it). "
                      "Use a larger terrain.",
                      name));
  return asset;
}

DesignTable first_rows(const DesignTable& whole, std::int64_t n) {
  DesignTable part = whole;
  part.values.resize(static_cast<std::size_t>(n));
  if (!part.unit_cube.empty()) part.unit_cube.resize(static_cast<std::size_t>(n));
  return part;
}

/// The design up to the first look, or to the one that the folder had come to.
void begin_with_first_look(EnsembleJob& job, bool begun) {
  const std::vector<std::int64_t>& looks = job.growth->looks;
  std::int64_t n = looks.front();
  if (begun) {
    const Manifest before = Manifest::read(job.folder.manifest());
    const auto had = saved_design(job.folder, before, job.scene.scenario).n_members();
    const auto next = std::lower_bound(looks.begin(), looks.end(), had);
    n = next == looks.end() ? looks.back() : *next;
  }
  job.design = first_rows(job.growth->whole, n);
  job.scene.scenario.ensemble.members = static_cast<int>(n);
}

std::shared_ptr<MemberWriter> writer_of(const EnsembleJob& job, const EnsembleRequest& request) {
  const std::int64_t planned = job.growth ? job.growth->whole.n_members() : job.design.n_members();
  const auto folder = job.folder.members();
  const MemberLayout layout = layout_of(folder, request.packs ? most_member_files + 1 : planned);
  return member_writer(folder, layout, {request.shard.k, request.shard.n});
}

}  // namespace

SceneRequest scene_of(const EnsembleRequest& request) {
  SceneRequest scene = request.scene;
  if (request.members > 0)  // the last override
    scene.overrides.push_back(fmt::format("ensemble.members={}", request.members));
  return scene;
}

void take_past(Manifest& now, const Manifest& before, const OutputFolder& folder,
               Observer& observer) {
  now.started = before.started;
  now.compute_s = before.compute_s;
  if (now.shards == 0) now.shards = before.shards;
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
      folder.root.string(), build_text(now.builds.back()), build_text(mine)));
  now.builds.push_back(mine);
}

void share_machine(EnsembleJob& job, Observer& observer) {
  const int wanted_workers = job.wanted_workers;
  const int available = available_cores();
  const int cores = job.max_cores > 0 ? std::min(job.max_cores, available) : available;
  const auto n = static_cast<int>(std::clamp<std::size_t>(job.to_do.size(), 1, 1 << 20));
  if (wanted_workers > cores)
    observer.warning(
        fmt::format("--workers {} on {} cores: {} members at a time, more would only wait for each "
                    "other.",
                    wanted_workers, cores, cores));
  job.workers = std::min({wanted_workers > 0 ? wanted_workers : cores, cores, n});
  const auto memory = static_cast<double>(job.scene.description.memory_bytes);
  const double free = available_memory_bytes();
  const double allowed = job.max_memory_bytes - resident_memory_bytes();
  const bool limited = job.max_memory_bytes > 0 && (free <= 0 || allowed < 0.9 * free);
  const double room = limited ? std::max(1.0, allowed) : 0.9 * free;
  if (memory > 0 && room > 0 && memory * job.workers > room) {
    const int fewer = std::max(1, static_cast<int>(room / memory));
    if (fewer < job.workers) {
      observer.warning(
          fmt::format("{} members at a time instead of {}: each needs {:.0f} MB and {:.0f} "
                      "MB are {}.",
                      fewer, job.workers, memory / 1e6, (limited ? room : free) / 1e6,
                      limited ? "allowed" : "free"));
      job.workers = fewer;
    }
  }
  job.threads = std::max(1, cores / job.workers);
}

void grow_design(EnsembleJob& job, std::int64_t n_members, Observer& observer) {
  const std::int64_t had = job.design.n_members();
  const Manifest saved = Manifest::read(job.folder.manifest());
  const DesignTable larger = first_rows(job.growth->whole, n_members);
  const std::string hash_before = design_hash(job.design);
  job.design = continued_design(job.folder, saved, job.scene.scenario, larger);
  job.scene.scenario.ensemble.members = static_cast<int>(n_members);
  Manifest& now = job.manifest;
  now.inputs = with_known_parts(now.inputs, job.scene.ground->identities());
  now.design_hash_before = hash_before;
  now.design_hash = design_hash(job.design);
  now.members = n_members;
  begin_folder(job);
  job.to_do.clear();
  find_work(job, {}, had, observer);
}

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
  const Shard& shard = request.shard;
  require(shard.k >= 1 && shard.k <= shard.n,
          fmt::format("shard {}/{} (must be k/n with 1 <= k <= n).", shard.k, shard.n));
  // Before the wanted number of members is held against a design that cannot grow.
  if (request.until_half_width)
    require_growing(read_scenario(request.scene.file, request.scene.overrides), shard);
  return prepare_ensemble(request, load_scene(scene_of(request)), observer);
}

EnsembleJob prepare_ensemble(const EnsembleRequest& request, Scene scene, Observer& observer) {
  const Shard shard = request.shard;
  require(scene.scenario.ensemble.estimator != Estimator::multilevel,
          "ensemble.estimator: multilevel (that is for `sturz ensemble` alone). Use --set "
          "ensemble.estimator=plain.");
  EnsembleJob job;
  job.scene = std::move(scene);
  job.design = new_design(job.scene.scenario);
  if (request.until_half_width) {
    job.growth = {*request.until_half_width, job.design, look_counts(job.design.n_members()), {}};
    if (!request.until_asset.empty())
      job.growth->asset = asset_named(job.scene.inputs.assets, request.until_asset);
  }
  // With a user's table the number of rows is the number of members.
  job.scene.scenario.ensemble.members = static_cast<int>(job.design.n_members());
  job.folder.root = request.folder;
  for (std::string& warning : ensemble_warnings(job.scene, job.design))
    job.scene.description.warnings.push_back(std::move(warning));
  if (!request.posterior.empty())
    for (std::string& warning : posterior_warnings(request.posterior, found_at(job.scene)))
      job.scene.description.warnings.push_back(std::move(warning));
  job.manifest = manifest_of(job.scene, "ensemble", request.command);
  job.manifest.shards = shard.n > 1 ? shard.n : request.planned_shards;
  job.manifest.scenario_hash = scenario_hash(job.scene.scenario);
  job.manifest.scene_hash = scene_hash(job.scene.scenario, job.scene.inputs.identities);

  holds_results(job.folder, "ensemble");  // refuses what is not ours before a lock is put there
  job.lock = shard.n > 1 ? FolderLock::shard(job.folder, shard, request.command)
                         : FolderLock::alone(job.folder, request.command);
  const bool begun = holds_results(job.folder, "ensemble");
  if (job.growth) begin_with_first_look(job, begun);
  if (begun)
    continue_folder(job, observer);
  else
    job.manifest.builds = {this_build()};
  job.manifest.members = job.design.n_members();
  job.manifest.design_hash = design_hash(job.design);
  if (!begun || shard.n == 1 || !stands_there(job)) begin_folder(job);
  keep_what_is_read(job);
  job.lock->others_may_come();
  observer.folder_ready(job.folder);
  job.retry_failed = request.retry_failed;
  job.writer = writer_of(job, request);
  // What a rule saw of the members is not what they will be.
  if (find_work(job, shard, 0, observer) > 0 && !job.growth) job.manifest.stop.reset();
  job.wanted_workers = request.workers;
  job.max_cores = request.max_cores;
  job.max_memory_bytes = request.max_memory_bytes;
  share_machine(job, observer);
  job.lock->say_workers(job.workers);
  return job;
}

}  // namespace sturz::workflow
