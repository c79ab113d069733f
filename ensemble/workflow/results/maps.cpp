// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/maps.hpp"

#include "ensemble/censoring/edge_crossing.hpp"
#include "ensemble/hazard/release_footprint.hpp"
#include "ensemble/members/members_table.hpp"
#include "ensemble/workflow/calibration/shown_posterior.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/frames/member_frames.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/results/asset_files.hpp"
#include "ensemble/workflow/results/gauge_files.hpp"
#include "ensemble/workflow/results/gis/gis_files.hpp"
#include "ensemble/workflow/results/hazard_file.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "io/files/atomic_file.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "io/site/map_ground.hpp"
#include "scenarios/layers/coarse_layers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <span>
#include <string_view>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// What the members say about themselves beyond what `describe` said before.
void add_members(MapsMade& made, const MemberStore& store, const Manifest& manifest,
                 const Scenario& scenario) {
  made.censoring = censoring_report(store.members(), scenario.ensemble.max_censored_fraction);
  made.valid = made.censoring.valid;
  made.warnings = member_warnings(store.members(), manifest.warnings);
  made.warned_members = std::count_if(store.members().begin(), store.members().end(),
                                      [](const MemberSummary& m) { return !m.warnings.empty(); });
}

/// Members against what was observed. Nothing of it is stored with them: an observation may come
/// later, or change, and only this is made anew.
void add_scores(MapsMade& made, const MemberStore& store, const SceneInputs& inputs,
                CancelFlag cancel) {
  if (!inputs.event) return;
  made.scores = score_members(store, inputs.event, cancel);
  for (const MemberSummary& m : store.members()) made.numbers.push_back(m.member);
}

void write_members_csv(const OutputFolder& folder, const DesignTable& design,
                       const MemberStore& store, const MapsMade& made) {
  AtomicFile file(folder.members_csv());
  members_csv(design, store.members(), made.scores ? &*made.scores : nullptr,
              [&](std::string_view piece) { file.write(std::as_bytes(std::span(piece))); });
  file.commit();
}

/// Until they are whole, no page is written over half of them.
void forget_maps(const OutputFolder& folder, Manifest& manifest) {
  manifest.hazard_hash.clear();
  manifest.maps_of.clear();
  manifest.write(folder.manifest());
}

/// A member may be lost or damaged between its computation and the maps.
void require_complete(const OutputFolder& folder, const MemberStore& store,
                      const DesignTable& design, Observer& observer) {
  const std::string what = what_is_missing(store, design.n_members());
  if (what.empty()) return;
  warn_of_problems(store, "It counts as missing.", observer);
  throw MembersMissing(
      fmt::format("{}: {} though all were computed, so no maps are made. The same "
                  "command computes them again.",
                  folder.root.string(), what));
}

/// \return the hash of what it wrote
std::string write_hazard_nc(const MapsRequest& request, const MemberStore& store,
                            const Raster<double>* ground, ConvergenceCount& convergence,
                            CancelFlag cancel) {
  HazardContext context = hazard_context(request.manifest, request.scenario, request.design);
  context.memory_bytes = records_memory_bytes(request.max_memory_bytes);
  context.ground = ground;
  context.whole_ground = request.inputs.terrain_grid();
  context.convergence = &convergence;
  context.cancel = cancel;
  return write_hazard(request.folder.hazard_nc(), store, request.scenario.hazard, context);
}

}  // namespace

bool MapsMade::too_many_failed() const {
  const double share =
      finished > 0 ? static_cast<double>(failed()) / static_cast<double>(finished) : 1;
  return share > max_failed_fraction;
}

MapsMade make_maps(const MapsRequest& request, const MemberStore& store, Observer& observer,
                   CancelFlag cancel) {
  const auto begin = Clock::now();
  const auto& [folder, manifest, scenario, design, inputs, max_memory_bytes] = request;
  observer.maps_begin();
  MapsMade made;
  made.folder = folder;
  made.max_failed_fraction = scenario.ensemble.max_failed_fraction;
  made.planned = design.n_members();
  made.stop = manifest.stop;
  made.finished = static_cast<std::int64_t>(store.members().size());
  add_members(made, store, manifest, scenario);
  manifest.censored = one_line(made.censoring);
  const Grid& grid = store.grid();  // no member, no maps: said before anything is written
  const auto ground = ground_of_map(scenario, inputs,
                                    grid_of(map_extent(MemberCells(store).touched(), grid), grid));

  forget_maps(folder, manifest);
  add_scores(made, store, inputs, cancel);
  write_members_csv(folder, design, store, made);
  const auto risk = find_risk(store, inputs, cancel);
  write_asset_files(folder, risk, grid);
  const GaugeFindings gauges = find_gauges(store, scenario, cancel);
  write_gauge_files(folder, gauges);
  ConvergenceCount convergence(static_cast<std::size_t>(made.valid));
  const std::string hash = write_hazard_nc(request, store, ground.get(), convergence, cancel);
  const LayersFileReader maps(folder.hazard_nc());
  const LayerStack coarse = coarse_layers(maps, page_cells, cancel);
  made.censoring.where = where_mass_left(coarse, inputs.terrain_grid());

  PageContent page;
  page.hazard = &coarse;
  page.design = &design;
  page.elevation = ground.get();
  page.members = store.members();
  const auto points = made.valid > 0 ? convergence.points(grid.cell_m * grid.cell_m)
                                     : std::vector<ConvergencePoint>{};
  page.convergence = points;
  page.cancel = cancel;
  page.stop = manifest.stop ? &*manifest.stop : nullptr;
  page.where_mass_left = made.censoring.where;
  const Raster<std::uint8_t> release = release_footprint(store);
  page.release = &release;
  page.gauges = &gauges;
  std::optional<FramesShown> frames;
  if (scenario.report.animation)
    frames = frames_of_middle(scenario, design, inputs, store.members(), cancel);
  if (frames) {
    write_frames(folder, *frames);
    page.frames = &*frames;
  }
  page.observed = inputs.observed;
  page.overlays = inputs.overlays;
  const NearestMember nearest = nearest_member(store, made.scores, inputs.event);
  page.scores = made.scores ? &*made.scores : nullptr;
  page.nearest = &nearest;
  if (risk) page.risk = &*risk;
  manifest.hazard_hash = hash;
  manifest.maps_of = members_hash(store, design.n_members());
  const auto posterior = shown_posterior(folder, manifest, scenario, observer);
  if (posterior) page.posterior = &*posterior;
  write_all_for_gis(folder, scenario, gis_content(maps, page, manifest, scenario, inputs));
  write_page(folder, manifest, scenario, page);
  manifest.write(folder.manifest());
  made.hazard_hash = hash;
  made.seconds = seconds_since(begin);
  return made;
}

MapsMade make_maps(EnsembleJob& job, Observer& observer, CancelFlag cancel) {
  job.lock->require_ours();
  job.manifest.compute_s += seconds_since(job.begin);
  // Members may have read more of the raster than the first look did.
  job.manifest.inputs = with_known_parts(job.manifest.inputs, job.scene.ground->identities());
  const MemberStore store = members_of(job.folder, job.manifest, job.design, {}, cancel);
  require_complete(job.folder, store, job.design, observer);
  return make_maps({job.folder, job.manifest, job.scene.scenario, job.design, job.scene.inputs,
                    job.max_memory_bytes},
                   store, observer, cancel);
}

}  // namespace sturz::workflow
