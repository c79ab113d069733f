// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/weighted_maps.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/hazard_layers.hpp"
#include "ensemble/hazard/release_footprint.hpp"
#include "ensemble/hazard/weighting/weighted_sample.hpp"
#include "ensemble/workflow/calibration/posterior_weights.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/results/gis/gis_files.hpp"
#include "ensemble/workflow/results/hazard_file.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "io/files/atomic_file.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "io/site/map_ground.hpp"
#include "scenarios/layers/coarse_layers.hpp"

#include <fmt/core.h>

namespace sturz::workflow {
namespace {

std::vector<std::string> warnings_of(const WeightedMapsMade& made) {
  if (!(made.effective_members < least_effective_of_maps)) return {};
  return {fmt::format(
      "the {} valid members are worth {:.1f} under the posterior, fewer than {}: the weighted maps "
      "are little more than those of their heaviest members. Draw members from the posterior "
      "(`sturz ensemble --posterior`), or compute more.",
      made.valid, made.effective_members, least_effective_of_maps)};
}

/// The page shows weighted maps and members that count alike: it says so before all else.
Manifest page_manifest(const MergeInput& of, const WeightedMapsMade& made) {
  Manifest manifest = of.finished.manifest;
  manifest.hazard_hash = made.hazard_hash;
  manifest.weighting = weighting_text(made.effective_members);
  const std::string kind = "These maps are " + manifest.weighting +
                           ", and so are the sentence above and the medians. Single members, "
                           "their histogram and their largest values are of the ensemble as it was "
                           "drawn.";
  manifest.warnings.insert(manifest.warnings.begin(), kind);
  manifest.warnings.insert(manifest.warnings.begin() + 1, made.warnings.begin(),
                           made.warnings.end());
  return manifest;
}

}  // namespace

WeightedMapsMade make_weighted_maps(const MergeRequest& request,
                                    const std::filesystem::path& posterior, Observer& observer,
                                    CancelFlag cancel) {
  const MergeInput of = open_for_maps(request, observer, cancel);
  const auto weights = posterior_weights(posterior, members_hash(of.store, of.design.n_members()),
                                         of.store.members());
  WeightedMapsMade made;
  made.folder.root = of.finished.folder.root / "weighted";
  made.valid = static_cast<std::int64_t>(weights.size());
  made.effective_members = effective_size(weights);
  made.warnings = warnings_of(made);
  observer.maps_begin();
  const SceneInputs& inputs = *of.finished.inputs;
  const Scenario& scenario = of.finished.scenario;
  const Grid& grid = of.store.grid();
  const auto ground = ground_of_map(
      scenario, inputs, grid_of(map_extent(MemberCells(of.store).touched(), grid), grid));
  HazardContext context = hazard_context(of.finished.manifest, scenario, of.design);
  context.memory_bytes = records_memory_bytes();
  context.ground = ground.get();
  context.whole_ground = inputs.terrain_grid();
  context.weights = weights;
  context.cancel = cancel;
  make_folder(made.folder.root);
  made.hazard_hash = write_hazard(made.folder.hazard_nc(), of.store, scenario.hazard, context);
  const LayersFileReader maps(made.folder.hazard_nc());
  const LayerStack coarse = coarse_layers(maps, page_cells, cancel);

  PageContent page;
  page.scenario_file = of.finished.folder.scenario();
  page.hazard = &coarse;
  page.design = &of.design;
  page.effective_members = made.effective_members;
  page.weights = weights;
  page.elevation = ground.get();
  page.members = of.store.members();
  page.cancel = cancel;
  const Raster<std::uint8_t> release = release_footprint(of.store);
  page.release = &release;
  page.observed = inputs.observed;
  const Manifest manifest = page_manifest(of, made);
  write_all_for_gis(made.folder, scenario, gis_content(maps, page, manifest, scenario, inputs));
  write_page(made.folder, manifest, scenario, page);
  return made;
}

}  // namespace sturz::workflow
