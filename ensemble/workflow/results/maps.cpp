// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/maps.hpp"

#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/members/members_table.hpp"
#include "ensemble/workflow/results/map_files.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/files/text_files.hpp"
#include "io/members/member_store.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "scenarios/layers/coarse_layers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

HazardContext context_of(const Manifest& manifest, const Scenario& scenario,
                         const DesignTable& design) {
  HazardContext context;
  context.spacing_m = scenario.numerics.spacing_m;
  context.n_planned = design.n_members();
  context.attributes = {{"title", scenario.title.empty() ? "Landslide hazard" : scenario.title},
                        {"source", fmt::format("sturz {} ({})", version, git_commit)},
                        {"history", fmt::format("{} sturz {}", manifest.started, manifest.command)},
                        {"design", fmt::format("{}, {} members, seed {}", to_string(design.design),
                                               design.n_members(), design.seed)}};
  return context;
}

/// What a killed process left of files that only the making of maps writes.
void remove_parts(const OutputFolder& folder) {
  std::error_code failed;
  const auto remove_in = [&](const fs::path& place, auto is_ours) {
    for (const auto& entry : fs::directory_iterator(place, failed))
      if (entry.path().extension() == ".part" && is_ours(entry.path().filename().string()))
        fs::remove(entry.path(), failed);
  };
  remove_in(folder.root, [](const std::string& name) {
    return name.starts_with("hazard.nc.") || name.starts_with("members.csv.") ||
           name.starts_with("report.html.");
  });
  for (const fs::path& place : {folder.tif_folder(), folder.tif_folder() / "bounds"})
    remove_in(place, [](const std::string&) { return true; });
}

/// Writes hazard.nc as the members pass by. \return the maps' hash
std::string write_hazard(const OutputFolder& folder, const MemberStore& store,
                         const HazardSpec& spec, const HazardContext& context) {
  LayersFileWriter file(folder.hazard_nc());
  HashingSink hashed(file);
  make_hazard_map(store, spec, context, hashed);
  context.cancel.check();
  file.commit();
  return fmt::format("{:016x}", hashed.value());
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
  const auto& [folder, manifest, scenario, design, elevation] = request;
  observer.maps_begin();
  remove_parts(folder);
  MapsMade made;
  made.folder = folder;
  made.max_failed_fraction = scenario.ensemble.max_failed_fraction;
  made.planned = design.n_members();
  made.finished = static_cast<std::int64_t>(store.members().size());
  made.valid = std::count_if(store.members().begin(), store.members().end(),
                             [](const MemberSummary& m) { return is_valid(m.outcome); });
  store.grid();  // no member, no maps: said before anything is written
  // From here on the folder's files do not belong together until all are there.
  manifest.hazard_hash.clear();
  manifest.write(folder.manifest());

  write_text_atomic(folder.members_csv(), members_csv(design, store.members()));
  ConvergenceCount convergence(static_cast<std::size_t>(made.valid));
  HazardContext context = context_of(manifest, scenario, design);
  context.ground = elevation;
  context.convergence = &convergence;
  context.cancel = cancel;
  const std::string hash = write_hazard(folder, store, scenario.hazard, context);
  const LayersFileReader maps(folder.hazard_nc());
  const LayerStack coarse = coarse_layers(maps, page_cells, cancel);
  write_map_files(folder.tif_folder(), maps, coarse, cancel);

  PageContent page;
  page.hazard = &coarse;
  page.design = &design;
  page.elevation = elevation;
  page.members = store.members();
  const double cell_m = store.grid().cell_m;
  const auto points =
      made.valid > 0 ? convergence.points(cell_m * cell_m) : std::vector<ConvergencePoint>{};
  page.convergence = points;
  page.cancel = cancel;
  manifest.hazard_hash = hash;
  write_page(folder, manifest, scenario, page);
  manifest.write(folder.manifest());
  made.hazard_hash = hash;
  made.seconds = seconds_since(begin);
  return made;
}

MapsMade make_maps(EnsembleJob& job, Observer& observer, CancelFlag cancel) {
  job.manifest.compute_s += seconds_since(job.begin);
  const MemberStore store(job.folder.members(), MemberCheck::open, cancel);
  return make_maps(
      {job.folder, job.manifest, job.scene.scenario, job.design, job.scene.inputs.elevation.get()},
      store, observer, cancel);
}

}  // namespace sturz::workflow
