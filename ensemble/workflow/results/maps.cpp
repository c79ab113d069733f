// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/maps.hpp"

#include "ensemble/censoring/edge_crossing.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/release_footprint.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/members/members_table.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/files/text_files.hpp"
#include "io/gdal/cog.hpp"
#include "io/netcdf/netcdf_layers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>

namespace sturz::workflow {
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

LayerStack hazard_of(const MemberStore& store, const Manifest& manifest, const Scenario& scenario,
                     const DesignTable& design) {
  HazardContext context;
  context.spacing_m = scenario.numerics.spacing_m;
  context.n_planned = design.n_members();
  context.attributes = {{"title", scenario.title.empty() ? "Landslide hazard" : scenario.title},
                        {"source", fmt::format("sturz {} ({})", version, git_commit)},
                        {"history", fmt::format("{} sturz {}", manifest.started, manifest.command)},
                        {"censored_members", manifest.censored},
                        {"design", fmt::format("{}, {} members, seed {}", to_string(design.design),
                                               design.n_members(), design.seed)}};
  return make_hazard_map(store, scenario.hazard, context);
}

/// The folder then holds these maps and none that an earlier call made, say of other thresholds.
/// Files that the manifest does not list are the user's own and stay.
void write_tifs(const OutputFolder& folder, const LayerStack& hazard, Manifest& manifest) {
  const std::vector<std::string> before = manifest.map_files;
  std::vector<std::string> now = cog_names(hazard);
  std::set<std::string> ours(now.begin(), now.end());
  // Listed before they are there: a run that is killed leaves none that no manifest lists.
  manifest.map_files.insert(manifest.map_files.end(), now.begin(), now.end());
  manifest.write(folder.manifest());
  write_cogs(folder.tif_folder(), hazard);
  std::error_code ignored;
  for (const std::string& name : before)
    if (!ours.contains(name)) std::filesystem::remove(folder.tif_folder() / name, ignored);
  manifest.map_files = std::move(now);
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

}  // namespace

bool MapsMade::too_many_failed() const {
  const double share =
      finished > 0 ? static_cast<double>(failed()) / static_cast<double>(finished) : 1;
  return share > max_failed_fraction;
}

MapsMade make_maps(const OutputFolder& folder, Manifest& manifest, const Scenario& scenario,
                   const DesignTable& design, const Raster<double>* elevation, Observer& observer,
                   Missing missing) {
  const auto begin = Clock::now();
  observer.maps_begin();
  const MemberStore store = members_of(folder, manifest, design);
  if (missing == Missing::refuse) require_complete(folder, store, design, observer);
  MapsMade made;
  made.folder = folder;
  made.max_failed_fraction = scenario.ensemble.max_failed_fraction;
  made.planned = design.n_members();
  made.finished = static_cast<std::int64_t>(store.members().size());
  add_members(made, store, manifest, scenario);
  manifest.censored = one_line(made.censoring);

  // Until they are whole, no page is written over half of them.
  manifest.hazard_hash.clear();
  manifest.maps_of.clear();
  manifest.write(folder.manifest());
  write_text_atomic(folder.members_csv(), members_csv(design, store.members()));
  const LayerStack hazard = hazard_of(store, manifest, scenario, design);
  write_layers(folder.hazard_nc(), hazard);
  write_tifs(folder, hazard, manifest);
  manifest.hazard_hash = fmt::format("{:016x}", hash_of(hazard));
  manifest.maps_of = members_hash(store, design.n_members());
  if (elevation != nullptr) made.censoring.where = where_mass_left(hazard, elevation->grid);
  manifest.write(folder.manifest());

  PageContent page;
  page.hazard = &hazard;
  page.design = &design;
  page.elevation = elevation;
  page.members = store.members();
  const auto convergence = probability_convergence(store);
  page.convergence = convergence;
  page.where_mass_left = made.censoring.where;
  const Raster<std::uint8_t> release = release_footprint(store);
  page.release = &release;
  write_page(folder, manifest, scenario, page);
  made.hazard_hash = manifest.hazard_hash;
  made.seconds = seconds_since(begin);
  return made;
}

MapsMade make_maps(EnsembleJob& job, Observer& observer) {
  job.manifest.compute_s += seconds_since(job.begin);
  // Members may have read more of the raster than the first look did.
  job.manifest.inputs = with_known_parts(job.manifest.inputs, job.scene.ground->now()->identities);
  return make_maps(job.folder, job.manifest, job.scene.scenario, job.design,
                   job.scene.inputs.elevation.get(), observer);
}

}  // namespace sturz::workflow
