// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/report_page.hpp"

#include "engine/core/error.hpp"
#include "ensemble/censoring/edge_crossing.hpp"
#include "ensemble/hazard/release_footprint.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/workflow/calibration/shown_posterior.hpp"
#include "ensemble/workflow/folder/finished_folder.hpp"
#include "ensemble/workflow/folder/folder_lock.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/input_check.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/frames/member_frames.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/region/region_folder.hpp"
#include "ensemble/workflow/results/gauge_files.hpp"
#include "io/files/plain_text.hpp"
#include "io/files/seal.hpp"
#include "io/files/text_files.hpp"
#include "io/members/member_file.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "io/site/map_ground.hpp"
#include "io/site/overlays/orthophoto.hpp"
#include "reports/page/report.hpp"
#include "reports/texts/text_table.hpp"
#include "scenarios/assembly/ground_words.hpp"
#include "scenarios/layers/coarse_layers.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace sturz::workflow {
namespace {

/// Of all members, largest first.
NamedSeconds sum_of_effects(std::span<const MemberSummary> members) {
  NamedSeconds sums;
  for (const MemberSummary& m : members) {
    for (const auto& [name, seconds] : m.effect_seconds.named()) add_seconds(sums, name, seconds);
    if (m.effect_seconds.empty() && m.scalars.wall_s > 0)
      add_seconds(sums, "members that do not say", m.scalars.wall_s);
  }
  std::stable_sort(sums.begin(), sums.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return sums;
}

/// What took less than a hundredth of the time comes as one.
NamedSeconds largest_first(NamedSeconds passes) {
  std::stable_sort(passes.begin(), passes.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  double total = 0, rest = 0;
  for (const auto& [name, seconds] : passes) total += seconds;
  int n_small = 0;
  while (!passes.empty() && passes.back().second < 0.01 * total) {
    rest += passes.back().second;
    ++n_small;
    passes.pop_back();
  }
  if (n_small > 0) passes.emplace_back(fmt::format("{} others under 1 % each", n_small), rest);
  return passes;
}

/// Relief of another ground than the members' would mislead, and a page without it says why.
void leave_out_relief(FinishedFolder& finished, Observer& observer) {
  std::string why = finished.unreadable;
  if (!finished.changed.empty()) {
    why =
        "the input files are not what the members were computed from any more, so the page has no "
        "relief:" +
        as_lines(finished.changed);
    observer.warning(why);
    finished.inputs.reset();
  }
  if (!why.empty()) finished.manifest.warnings.push_back(as_utf8(why));  // for the page alone
}

/// What the file holds is what was made: the manifest knows its hash.
void require_own_maps(const std::filesystem::path& file, const Manifest& manifest,
                      const HashingSource& maps, CancelFlag cancel) {
  if (manifest.hazard_hash.empty()) return;  // runs of versions before
  const std::string hash = fmt::format("{:016x}", maps.value(cancel));
  require(hash == manifest.hazard_hash,
          fmt::format("{} does not hold the maps that were made of this folder's members (their "
                      "hash is {}, manifest.json says {}). {}",
                      file.string(), hash, manifest.hazard_hash,
                      manifest.kind == "run" ? "Run the scene again."
                                             : "Make them again with `sturz merge`."));
}

/// A page of some members over the maps of others would mislead.
void require_maps_of(const OutputFolder& folder, const Manifest& manifest, const MemberStore& store,
                     const DesignTable& design) {
  const bool whole = !manifest.hazard_hash.empty();
  require(whole && manifest.maps_of == members_hash(store, design.n_members()),
          fmt::format("{}: {} (the page would show what does not belong together; {} of {} members "
                      "are finished). Run the same `sturz ensemble` again, or make the maps with "
                      "`sturz merge`{}.",
                      folder.root.string(),
                      whole ? "its maps were made from other members than it holds now"
                            : "its maps are not finished",
                      store.members().size(), design.n_members(),
                      static_cast<std::int64_t>(store.members().size()) < design.n_members()
                          ? " --partial"
                          : ""));
}

/// The table goes with the page: both are of today's assets.
std::optional<AssetFindings> assets_anew(const FinishedFolder& finished, const MemberStore& store,
                                         CancelFlag cancel) {
  if (!finished.inputs || finished.manifest.kind == "run") return {};
  std::optional<AssetFindings> risk = find_risk(store, *finished.inputs, cancel);
  write_asset_files(finished.folder, risk, store.grid());
  return risk;
}

/// What the page shows. \throws SetupError when it is not there
std::filesystem::path existing_maps(const OutputFolder& folder, bool one_run) {
  const auto maps = one_run ? folder.peaks_nc() : folder.hazard_nc();
  require(std::filesystem::exists(maps),
          fmt::format("{} does not exist (the page shows its maps). {}", maps.string(),
                      one_run ? "Run the scene again." : "Make it with `sturz merge`."));
  return maps;
}

/// A region's page goes with its maps.
FinishedFolder open_with_page(const std::filesystem::path& folder, Observer& observer) {
  require(!is_region(folder),
          fmt::format("{} is a region, whose page is made with its maps. Use `sturz merge`.",
                      folder.string()));
  return open_finished(folder, observer);
}

}  // namespace

std::vector<std::string> still_true(std::vector<std::string> warnings,
                                    std::span<const MemberSummary> members) {
  const bool left = std::any_of(members.begin(), members.end(), [](const MemberSummary& m) {
    return !is_valid(m.outcome) || has_left(m.censoring);
  });
  if (!left && !members.empty())
    std::erase_if(warnings, [](const std::string& w) { return w.starts_with(edge_warning); });
  return warnings;
}

void require_language(const std::string& language, const std::string& asked) {
  const std::vector<std::string> known = page_languages();
  const bool there = std::find(known.begin(), known.end(), language) != known.end();
  require(language.empty() || there,
          fmt::format("{}: {} (the page has no texts in that language). Use one of {}.", asked,
                      language, comma_separated(known)));
}

NearestMember nearest_member(const MemberParts& source, const std::optional<ScoreTable>& scores,
                             const std::shared_ptr<const ObservedEvent>& event) {
  if (!scores) return {};
  const std::vector<std::size_t> rows = best_rows(*scores);
  if (rows.empty()) return {};
  return {source.members()[rows.front()].member, shown_cells(source, rows.front(), event)};
}

void write_page(const OutputFolder& folder, const Manifest& manifest, const Scenario& scenario,
                const PageContent& content) {
  ReportInput input;
  if (!scenario.report.language.empty()) input.language = scenario.report.language;
  input.overlays = content.overlays;
  if (!scenario.report.orthophoto.empty())
    input.orthophoto = [&scenario](const Grid& view) { return orthophoto_jpeg(scenario, view); };
  input.title = scenario.title.empty() ? as_utf8(folder.root.filename().string()) : scenario.title;
  input.scenario_yaml =
      read_text(content.scenario_file.empty() ? folder.scenario() : content.scenario_file);
  input.manifest = manifest.lines();
  input.elevation = content.elevation;
  input.hazard = content.hazard;
  input.peaks = content.peaks;
  input.gauges = content.gauges;
  input.frames = content.frames;
  input.effective_members = content.effective_members;
  input.weights.assign(content.weights.begin(), content.weights.end());
  input.members.assign(content.members.begin(), content.members.end());
  if (content.design && !content.design->keys.empty())
    input.samples = sampled_values(*content.design, content.members);
  if (content.design) input.n_planned = content.design->n_members();
  input.convergence.assign(content.convergence.begin(), content.convergence.end());
  if (content.stop != nullptr) input.stop_rule = stop_text(*content.stop);
  input.max_censored_fraction = scenario.ensemble.max_censored_fraction;
  input.where_mass_left = content.where_mass_left;
  input.release = content.release;
  input.observed = content.observed;
  input.observed_note = scenario.hazard.observed_note;
  input.scores = content.scores;
  input.posterior = content.posterior;
  if (content.risk != nullptr) {
    input.assets = content.risk->assets.get();
    input.risk = &content.risk->risk;
  }
  if (content.nearest != nullptr && content.nearest->member) {
    input.nearest = &content.nearest->cells;
    input.nearest_member = *content.nearest->member;
  }
  input.warnings = still_true(manifest.warnings, content.members);
  input.notes = manifest.notes;
  input.cancel = content.cancel;
  input.description = manifest.description;
  if (content.run) {
    input.history = &content.run->history;
    input.pass_timings = largest_first(content.run->pass_seconds);
  }
  input.timings = sum_of_effects(content.members);
  input.elapsed_s = manifest.compute_s;
  const bool particles =
      std::any_of(content.members.begin(), content.members.end(), [](const MemberSummary& m) {
        return m.formulation != to_string(Formulation::depth_averaged);
      });
  input.resolved_thickness_m = particles ? 0.5 * manifest.spacing_m : 0;
  write_text_atomic(folder.report(), make_report(input));
}

std::filesystem::path rewrite_page(const std::filesystem::path& folder, Observer& observer,
                                   CancelFlag cancel, const std::string& language) {
  require_language(language, "--language");
  FinishedFolder finished = open_with_page(folder, observer);
  if (!language.empty()) finished.scenario.report.language = language;
  const auto lock = FolderLock::alone(finished.folder, "report " + folder.string());
  finished.manifest = Manifest::read(finished.folder.manifest());  // no other process writes it now
  leave_out_relief(finished, observer);
  const bool one_run = finished.manifest.kind == "run";
  const auto maps = existing_maps(finished.folder, one_run);
  DesignTable design;
  if (!one_run) design = saved_design(finished.folder, finished.manifest, finished.scenario);
  const MemberStore store =
      one_run ? MemberStore(finished.folder.members(), {}, cancel)
              : members_of(finished.folder, finished.manifest, design, {}, cancel);
  warn_of_problems(store, "The page does without it.", observer);
  if (!one_run) require_maps_of(finished.folder, finished.manifest, store, design);
  if (seal_state(maps) == SealState::broken) require_sealed(maps);
  observer.maps_begin();
  const LayersFileReader reader(maps);
  const HashingSource hashed(reader);
  const LayerStack stack = coarse_layers(hashed, page_cells, cancel);
  require_own_maps(maps, finished.manifest, hashed, cancel);
  std::shared_ptr<const Raster<double>> ground;
  if (finished.inputs)
    ground = ground_of_map(finished.scenario, *finished.inputs, reader.about().grid);
  std::vector<ConvergencePoint> convergence;
  MemberResult run;
  PageContent page;
  page.cancel = cancel;
  if (finished.inputs) page.overlays = finished.inputs->overlays;
  (one_run ? page.peaks : page.hazard) = &stack;
  if (!one_run) {
    page.design = &design;
    page.stop = finished.manifest.stop ? &*finished.manifest.stop : nullptr;
    convergence = probability_convergence(store, records_memory_bytes(), 40, cancel);
    page.convergence = convergence;
  }
  page.elevation = ground.get();
  const Raster<std::uint8_t> release = release_footprint(store);
  page.release = &release;
  if (finished.inputs) page.observed = finished.inputs->observed;
  std::optional<ScoreTable> scores;
  NearestMember nearest;
  if (finished.inputs && finished.inputs->event) {
    scores = score_members(store, finished.inputs->event, cancel);
    nearest = nearest_member(store, scores, finished.inputs->event);
    page.scores = &*scores;
    page.nearest = &nearest;
  }
  if (finished.inputs)
    page.where_mass_left = where_mass_left(stack, finished.inputs->terrain_grid());
  const std::optional<AssetFindings> risk = assets_anew(finished, store, cancel);
  if (risk) page.risk = &*risk;
  std::optional<PosteriorShown> posterior;
  if (!one_run)
    posterior = shown_posterior(finished.folder, finished.manifest, finished.scenario, observer);
  if (posterior) page.posterior = &*posterior;
  page.members = store.members();
  if (one_run && !page.members.empty()) {
    run = read_member(finished.folder.members() / member_file_name(page.members.front().member));
    page.run = &run;
  }
  const GaugeFindings gauges =
      one_run ? find_gauges(run) : find_gauges(store, finished.scenario, cancel);
  page.gauges = &gauges;
  const std::optional<FramesShown> frames = read_frames(finished.folder);
  if (frames) page.frames = &*frames;
  write_page(finished.folder, finished.manifest, finished.scenario, page);
  return finished.folder.report();
}

}  // namespace sturz::workflow
