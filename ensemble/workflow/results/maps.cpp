// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/maps.hpp"

#include "ensemble/censoring/edge_crossing.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/release_footprint.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/members/members_table.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/files/text_files.hpp"
#include "io/gdal/cog.hpp"
#include "io/members/member_store.hpp"
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

/// The folder then holds these maps and no older ones, say of other thresholds.
void write_tifs(const OutputFolder& folder, const LayerStack& hazard) {
  const auto written = write_cogs(folder.tif_folder(), hazard);
  std::set<std::filesystem::path> names;
  for (const auto& file : written) names.insert(file.filename());
  for (const auto& entry : std::filesystem::directory_iterator(folder.tif_folder()))
    if (entry.path().extension() == ".tif" && !names.contains(entry.path().filename()))
      std::filesystem::remove(entry.path());
}

}  // namespace

bool MapsMade::too_many_failed() const {
  const double share =
      finished > 0 ? static_cast<double>(failed()) / static_cast<double>(finished) : 1;
  return share > max_failed_fraction;
}

MapsMade make_maps(const OutputFolder& folder, Manifest& manifest, const Scenario& scenario,
                   const DesignTable& design, const Raster<double>* elevation, Observer& observer) {
  const auto begin = Clock::now();
  observer.maps_begin();
  const MemberStore store(folder.members());
  MapsMade made;
  made.folder = folder;
  made.max_failed_fraction = scenario.ensemble.max_failed_fraction;
  made.planned = design.n_members();
  made.finished = static_cast<std::int64_t>(store.members().size());
  add_members(made, store, manifest, scenario);
  manifest.censored = one_line(made.censoring);

  write_text_atomic(folder.members_csv(), members_csv(design, store.members()));
  const LayerStack hazard = hazard_of(store, manifest, scenario, design);
  write_layers(folder.hazard_nc(), hazard);
  write_tifs(folder, hazard);
  manifest.hazard_hash = fmt::format("{:016x}", hash_of(hazard));
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
  return make_maps(job.folder, job.manifest, job.scene.scenario, job.design,
                   job.scene.inputs.elevation.get(), observer);
}

}  // namespace sturz::workflow
