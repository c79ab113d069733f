// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/region/region_job.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/finished_folder.hpp"
#include "ensemble/workflow/folder/input_check.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/region/region_record.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"
#include "io/scenario/scenario_file.hpp"
#include "io/site/release/release_features.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace sturz::workflow {
namespace {

/// Scenario and sources; what is wrong with them is told with its place in the file.
void read_region(const SceneRequest& scene, RegionJob& job) {
  ScenarioFile file = read_scenario_file(scene.file, scene.overrides);
  job.scenario = std::move(file.scenario);
  try {
    job.sources = release_features(job.scenario);
    for (const std::string& source : job.sources) source_file_name(source);
  } catch (const SetupError& problem) {
    throw SetupError(at_their_places(problem.what(), file.positions));
  }
}

/// The first source whose scene can be loaded. What is wrong with the raster, say, is wrong with
/// every one.
void find_typical(const SceneRequest& scene, RegionJob& job) {
  std::string reason;
  for (const std::string& source : job.sources) {
    SceneRequest request = source_scene(scene, source);
    request.predicts = true;
    try {
      job.typical = load_scene(request);
      job.typical_of = source;
      return;
    } catch (const SetupError& problem) {
      if (reason.empty()) reason = problem.what();
    }
  }
  throw SetupError(
      fmt::format("no feature makes a scene; the first of {}: {}", job.sources.size(), reason));
}

Manifest new_manifest(const RegionJob& job) {
  Manifest m = manifest_of(job.typical, "region", job.request.command);
  m.inputs.clear();  // each source's own manifest has its inputs
  m.members = job.design.n_members() * static_cast<std::int64_t>(job.sources.size());
  m.description.insert(m.description.begin(),
                       {fmt::format("region: {} sources, {} members each", job.sources.size(),
                                    job.design.n_members()),
                        "what follows is said of source " + job.typical_of});
  m.scenario_hash = scenario_hash(job.scenario);
  m.design_hash = design_hash(job.design);
  m.builds = {this_build()};
  m.warnings.clear();
  m.notes.clear();
  return m;
}

void continue_region(RegionJob& job, Observer& observer) {
  const Scenario was = read_scenario(job.folder.scenario());
  const std::string what = as_lines(differences(was, job.scenario));
  require(what.empty(),
          fmt::format("{} was begun with another scene (its results would be mixed or lost). "
                      "Choose another folder with --out, or take these changes back:{}",
                      job.folder.root.string(), what));
  const Manifest before = Manifest::read(job.folder.manifest());
  Scenario of_source = job.scenario;
  of_source.release.each_feature = false;
  job.design = continued_design(job.folder, before, of_source, job.design);
  job.manifest.design_hash_before = design_hash(saved_design(job.folder, before, of_source));
  take_past(job.manifest, before, job.folder, observer);
}

/// As begin_folder() of an ensemble, and for the same reasons in this order.
void begin_region(RegionJob& job) {
  make_folder(job.folder.root);
  job.manifest.write(job.folder.manifest());
  write_text_atomic(job.folder.design(), to_csv(job.design));
  save_scenario(job.folder, job.scenario);
}

void share_cores(RegionJob& job, Observer& observer) {
  EnsembleJob all;
  all.scene.description = job.typical.description;
  all.to_do.resize(std::min<std::size_t>(
      job.sources.size() * static_cast<std::size_t>(job.design.n_members()), 1 << 16));
  all.wanted_workers = job.request.workers;
  share_machine(all, observer);
  job.workers = all.workers;
  job.threads = all.threads;
}

}  // namespace

RegionJob prepare_region(const EnsembleRequest& request, Observer& observer) {
  require(!request.until_half_width,
          "--until-converged with a region (each source would stop elsewhere, and the rows that "
          "all share would not be the same). Give the number of members with -n.");
  const Shard shard = request.shard;
  require(shard.k >= 1 && shard.k <= shard.n,
          fmt::format("shard {}/{} (must be k/n with 1 <= k <= n).", shard.k, shard.n));
  const SceneRequest scene = scene_of(request);
  RegionJob job;
  job.request = request;
  read_region(scene, job);
  job.folder.root = request.folder;
  holds_results(job.folder, "region");  // refuses what is not ours before anything is computed
  find_typical(scene, job);
  job.design = new_design(job.typical.scenario);
  job.scenario.ensemble.members = static_cast<int>(job.design.n_members());
  job.manifest = new_manifest(job);
  job.lock = shard.n > 1 ? FolderLock::shard(job.folder, shard, request.command)
                         : FolderLock::alone(job.folder, request.command);
  if (holds_results(job.folder, "region")) continue_region(job, observer);
  job.manifest.design_hash = design_hash(job.design);
  begin_region(job);
  job.lock->others_may_come();
  observer.folder_ready(job.folder);
  share_cores(job, observer);
  return job;
}

RegionJob reopen_region(const std::filesystem::path& folder, Observer& observer,
                        CancelFlag cancel) {
  RegionJob job;
  job.folder.root = folder;
  require(is_region(folder) && std::filesystem::exists(job.folder.scenario()),
          fmt::format("{} is no region (manifest.json says so, or scenario.yaml is missing).",
                      folder.string()));
  job.scenario = read_scenario(job.folder.scenario());
  job.request.scene.file = job.folder.scenario().string();
  job.request.command = "merge " + folder.string();
  job.lock = FolderLock::alone(job.folder, job.request.command);
  job.manifest = Manifest::read(job.folder.manifest());
  require_own_scenario(job.folder, job.manifest, job.scenario);
  job.sources = release_features(job.scenario);
  find_typical(job.request.scene, job);
  Scenario of_source = job.scenario;
  of_source.release.each_feature = false;
  job.design = saved_design(job.folder, job.manifest, of_source);
  const RegionRecord record(job.folder, job.manifest.design_hash, {});
  for (const std::string& source : job.sources) {
    cancel.check();
    if (record.is_finished(source, job.members_per_source())) continue;
    const OutputFolder own = source_folder(job.folder, source);
    if (failure_of(job.folder, source) || !std::filesystem::exists(own.scenario())) continue;
    const FinishedFolder finished = open_finished(own.root, observer);
    require(
        finished.inputs != nullptr && finished.changed.empty(),
        fmt::format("{}: its members were computed from other inputs. Take these changes "
                    "back:{}",
                    own.root.string(),
                    finished.inputs ? as_lines(finished.changed) : "\n  " + finished.unreadable));
  }
  observer.folder_ready(job.folder);
  return job;
}

RegionDescription describe_region(const SceneRequest& request, double trial_s, CancelFlag cancel) {
  constexpr std::size_t most_looked_at = 5;
  RegionJob job;
  read_region(request, job);
  find_typical(request, job);
  RegionDescription d;
  d.n_sources = job.sources.size();
  if (job.scenario.ensemble.members > 0 || job.scenario.ensemble.design == Design::table)
    job.design = new_design(job.typical.scenario);
  d.members_per_source = job.design.n_members();
  const std::size_t n = std::min(most_looked_at, d.n_sources);
  Range sum;
  for (std::size_t i = 0; i < n; ++i) {
    const std::string& source = job.sources[i * d.n_sources / n];
    try {
      SceneRequest of_source = source_scene(request, source);
      of_source.predicts = true;
      const Scene scene = load_scene(of_source);
      ForecastRequest wanted;
      wanted.design = &job.design;
      wanted.members = d.members_per_source;
      wanted.speed_cache = request.speed_cache;
      wanted.trial_s = trial_s / static_cast<double>(n);
      wanted.cancel = cancel;
      const Forecast f = forecast(scene, wanted);
      sum = sum + (d.members_per_source > 0 ? f.member_s : f.median_s);
      d.looked_at.push_back(source);
    } catch (const SetupError& problem) {
      d.failed.push_back(source + ": " + problem.what());
    }
  }
  if (!d.looked_at.empty()) d.member_s = sum * (1.0 / static_cast<double>(d.looked_at.size()));
  d.members_s = d.member_s * static_cast<double>(std::max<std::int64_t>(d.members_per_source, 1)) *
                static_cast<double>(d.n_sources);
  d.workers = available_cores();
  d.elapsed_s = d.members_s * (1.0 / d.workers);
  d.typical = std::move(job.typical);
  d.typical_of = std::move(job.typical_of);
  return d;
}

}  // namespace sturz::workflow
