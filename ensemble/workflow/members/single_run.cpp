// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/single_run.hpp"

#include "ensemble/censoring/edge_crossing.hpp"
#include "ensemble/hazard/release_footprint.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/workflow/cost_warnings.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"
#include "ensemble/workflow/forecast/forecast.hpp"
#include "ensemble/workflow/frames/member_frames.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/members/member_summary.hpp"
#include "ensemble/workflow/results/gauge_files.hpp"
#include "ensemble/workflow/results/gis/gis_files.hpp"
#include "ensemble/workflow/results/map_files.hpp"
#include "ensemble/workflow/results/peak_layers.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/files/atomic_file.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_store.hpp"
#include "io/members/particle_frames.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "io/site/map_ground.hpp"

#include <fmt/format.h>

#include <string>

namespace sturz::workflow {
namespace {

/// "grain stress 1.25 s; bed 0.31 s", for a text attribute.
std::string as_text(const NamedSeconds& times) {
  std::string text;
  for (const auto& [name, seconds] : times)
    text += fmt::format("{}{} {:.6g} s", text.empty() ? "" : "; ", name, seconds);
  return text;
}

/// So that a run which is stopped does not leave the results of one scene under the name of
/// another.
void remove_results(const OutputFolder& folder) {
  for (const auto& file : {folder.peaks_nc(), folder.report(), folder.gauges_csv(),
                           folder.gauge_series_csv(), folder.members() / "000000.nc"})
    std::filesystem::remove(file);
  remove_map_files(folder.peaks_folder());
  remove_gis_files(folder);
}

/// What is cut off, what was warned of before and what the run itself found: a line each.
std::string warnings_text(const RunStored& stored, const std::vector<std::string>& before) {
  std::vector<std::string> lines = censoring_sentences(stored.censoring);
  lines.insert(lines.end(), before.begin(), before.end());
  for (const MemberWarning& w : stored.warnings) lines.push_back(w.text);
  return fmt::format("{}", fmt::join(lines, "\n"));
}

/// What the description says of long runs may be off by a factor of three: they are tried first.
void warn_of_cost(Scene& scene, Observer& observer) {
  constexpr double worth_trying_s = 120;
  if (scene.description.predicted_seconds < worth_trying_s) return;
  scene.description.predicted_seconds = forecast(scene, {}).median_s.likely;
  for (const std::string& warning : cost_warnings(scene, 1, 1)) observer.warning(warning);
}

}  // namespace

SingleRun prepare_run(const RunRequest& request, Observer& observer) {
  SingleRun run;
  run.scene = load_scene(request.scene);
  run.folder.root = request.folder;
  run.threads = request.threads > 0 ? request.threads : available_cores();
  run.particles_every_s = request.particles_every_s;
  const auto& inputs = run.scene.inputs.identities;
  holds_results(run.folder, "run");  // refuses what is not ours before a lock is put there
  run.lock = FolderLock::alone(run.folder, request.command);
  if (holds_results(run.folder, "run")) {
    if (!request.replace)
      require_same_scene(run.folder, run.scene.medians, inputs);
    else
      remove_results(run.folder);
  }
  run.manifest = manifest_of(run.scene, "run", request.command);
  run.manifest.members = 1;
  run.manifest.builds = {this_build()};
  run.manifest.scenario_hash = scenario_hash(run.scene.medians);
  run.manifest.scene_hash = scene_hash(run.scene.medians, inputs);
  run.scene.ground->remember(run.manifest.inputs, {});
  make_folder(run.folder.root);
  run.manifest.write(run.folder.manifest());
  save_scenario(run.folder, run.scene.medians);
  observer.folder_ready(run.folder);
  warn_of_cost(run.scene, observer);
  return run;
}

MemberResult compute_run(const SingleRun& run, Observer& observer,
                         const std::atomic<bool>& cancel) {
  const bool animation = run.scene.medians.report.animation;
  RunControl control;
  control.max_wall_s = run.scene.medians.numerics.max_wall_time_s;
  control.on_progress = [&](const Progress& progress) {
    observer.run_progress(progress);
    return !cancel.load();
  };
  return run.scene.ground->computed([&](const SceneInputs& inputs) {
    Simulation simulation = assemble(run.scene.medians, inputs, 0, run.threads);
    FrameTaker taker;  // anew on more ground
    std::filesystem::remove(run.folder.frames_nc());
    remove_particle_frames(run.folder.particles());  // of an earlier run, or on less ground
    std::optional<ParticleFrameWriter> frames;
    if (run.particles_every_s) {
      frames.emplace(run.folder.particles());
      control.frame_every_s = *run.particles_every_s;
    } else {
      control.frame_every_s = FrameTaker::first_interval_s;
    }
    if (run.particles_every_s || animation)
      control.on_frame = [&](const ParticleFrame& frame) {
        if (frames) frames->write(frame);
        if (animation && frame.set_index == 0) taker.take(simulation.parts());
      };
    MemberResult result = simulation.run(control);
    if (animation) {
      taker.take(simulation.parts(), true);
      if (const auto shown = taker.frames(0, inputs.hazard_grid)) write_frames(run.folder, *shown);
    }
    return result;
  });
}

RunStored store_run(SingleRun& run, const MemberResult& result) {
  const OutputFolder& folder = run.folder;
  const Scene& scene = run.scene;
  Manifest& manifest = run.manifest;
  manifest.compute_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - run.begin).count();
  manifest.inputs = with_known_parts(manifest.inputs, run.scene.ground->identities());
  const MemberSummary summary = summary_of(result);
  const auto ground = ground_of_map(scene.medians, scene.inputs, map_grid(result));
  LayerStack peaks = peak_layers(result, ground.get(), scene.inputs.terrain_grid());
  RunStored stored{censoring_report({&summary, 1}, 0),
                   member_warnings({&summary, 1}, manifest.warnings)};
  if (scene.inputs.event) stored.scores = score_result(result, scene.inputs.event);
  stored.censoring.where = where_mass_left(peaks, scene.inputs.terrain_grid());
  manifest.censored = one_line(stored.censoring);
  manifest.hazard_hash = fmt::format("{:016x}", hash_of(peaks));
  manifest.write(folder.manifest());
  write_member(folder.members(), result,
               {member_hash(manifest.scene_hash), workflow::version, workflow::git_commit});
  peaks.attributes = {
      {"title", scene.scenario.title.empty() ? "Landslide run" : scene.scenario.title},
      {"source", fmt::format("sturz {} ({})", version, git_commit)},
      {"history", fmt::format("sturz {}", manifest.command)},
      {"outcome", std::string(to_string(result.outcome))},
      {"censored", std::string(to_string(result.censoring))},
      {"formulation", result.formulation},
      {"computing_time_by_effect", as_text(result.effect_seconds)}};
  if (const std::string said = warnings_text(stored, manifest.warnings); !said.empty())
    peaks.attributes.emplace_back("warnings", said);
  write_layers(folder.peaks_nc(), peaks, result.history);
  PageContent page;
  page.peaks = &peaks;
  page.elevation = ground.get();
  page.members = {&summary, 1};
  page.run = &result;
  page.where_mass_left = stored.censoring.where;
  const MemberStore store(folder.members());
  const Raster<std::uint8_t> release = release_footprint(store);
  page.release = &release;
  const GaugeFindings gauges = find_gauges(result);
  write_gauge_files(folder, gauges);
  page.gauges = &gauges;
  const std::optional<FramesShown> frames = read_frames(folder);
  if (frames) page.frames = &*frames;
  page.observed = scene.inputs.observed;
  page.overlays = scene.inputs.overlays;
  const NearestMember nearest = nearest_member(store, stored.scores, scene.inputs.event);
  page.scores = stored.scores ? &*stored.scores : nullptr;
  page.nearest = &nearest;
  write_page(folder, manifest, scene.medians, page);
  const LayersFileReader maps(folder.peaks_nc());
  write_all_for_gis(folder, scene.medians,
                    gis_content(maps, page, manifest, scene.medians, scene.inputs));
  return stored;
}

}  // namespace sturz::workflow
