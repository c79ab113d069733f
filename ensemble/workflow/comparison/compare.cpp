// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/comparison/compare.hpp"

#include "engine/core/error.hpp"
#include "ensemble/comparison/asset_differences.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/workflow/comparison/comparison_page.hpp"
#include "ensemble/workflow/folder/opened_ensemble.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/results/map_files.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/features/feature_file.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "io/site/map_ground.hpp"
#include "scenarios/layers/coarse_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

using Both = std::array<OpenedEnsemble, 2>;

MemberPairs pairs_of(const CompareRequest& request, const Both& both) {
  const auto &a = both[0], &b = both[1];
  if (!request.paired) return without_pairs(*a.members, *b.members);
  const std::string why = why_no_pairs(a.design, b.design);
  require(
      why.empty(),
      fmt::format("{} and {}: their members are no pairs ({}). Compute both with the same seed, "
                  "design and distributions, or compare them with --unpaired.",
                  a.name(), b.name(), why));
  MemberPairs pairs = find_pairs(*a.members, *b.members);
  require(pairs.n > 0, fmt::format("{} and {}: no member is valid in both (there are no pairs). "
                                   "Compare them with --unpaired.",
                                   a.name(), b.name()));
  return pairs;
}

std::vector<double> shared_thresholds(const Both& both) {
  const auto& a = both[0].finished.scenario.hazard.thickness_m;
  const auto& b = both[1].finished.scenario.hazard.thickness_m;
  std::vector<double> shared;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(shared));
  return shared;
}

void write_maps(const CompareRequest& request, const Both& both, const MemberPairs& pairs,
                CancelFlag cancel, Compared& made) {
  const JoinedMembers joined({both[0].members.get(), both[1].members.get()});
  const Grid& grid = joined.grid();
  const FinishedFolder& first = both[0].finished;
  const auto ground = ground_of_map(first.scenario, *first.inputs,
                                    grid_of(map_extent(MemberCells(joined).touched(), grid), grid));
  DifferenceContext context;
  context.thickness_m = made.thickness_m;
  context.ground = ground.get();
  context.whole_ground = first.inputs->terrain_grid();
  context.memory_bytes = records_memory_bytes();
  context.cancel = cancel;
  context.attributes = {{"title", "Two ensembles compared"},
                        {"source", fmt::format("sturz {} ({})", version, git_commit)},
                        {"ensemble_a", both[0].name()},
                        {"ensemble_b", both[1].name()},
                        {"maps_a", first.manifest.hazard_hash},
                        {"maps_b", both[1].finished.manifest.hazard_hash},
                        {"number_of_pairs", std::to_string(pairs.n)}};
  LayersFileWriter file(made.maps);
  made.summary = make_difference_maps(joined, pairs, context, file);
  cancel.check();
  file.commit();
  const LayersFileReader maps(made.maps);
  const LayerStack coarse = coarse_layers(maps, page_cells, cancel);
  write_map_files(request.out / "comparison", maps, coarse, cancel);
  made.has_page = write_comparison_page(request.out, both, maps, made, cancel);
}

fs::path asset_csv(const fs::path& out) { return out / "asset_differences.csv"; }
fs::path asset_gpkg(const fs::path& out) { return out / "asset_differences.gpkg"; }

/// They belong to the maps that were there.
void forget_assets(const fs::path& out) {
  fs::remove(asset_csv(out));
  fs::remove(asset_gpkg(out));
}

void write_assets(const CompareRequest& request, const Both& both, const MemberPairs& pairs,
                  CancelFlag cancel, Compared& made) {
  const auto assets = common_assets(both);
  if (assets == nullptr) return;
  const AssetHits a = find_hits(*both[0].members, *assets, cancel);
  const AssetHits b = find_hits(*both[1].members, *assets, cancel);
  const FeatureTable features = difference_features(
      *assets, asset_differences(*assets, pairs, a, b), both[0].members->grid().crs_wkt);
  write_text_atomic(asset_csv(request.out), to_csv(features));
  write_geopackage(asset_gpkg(request.out), features);
  made.n_assets = assets->list.size();
}

}  // namespace

Compared compare(const CompareRequest& request, Observer& observer, CancelFlag cancel) {
  require_free_of_results(request.out);
  Both both;
  both[0] = open_ensemble(request.a, observer, cancel);
  both[1] = open_ensemble(request.b, observer, cancel);
  require_same_maps(both);
  common_assets(both);  // what is wrong is said before anything is written
  const MemberPairs pairs = pairs_of(request, both);
  Compared made;
  made.n_pairs = pairs.n, made.n_a = pairs.n_a, made.n_b = pairs.n_b;
  for (const OpenedEnsemble& e : both)
    for (const MemberSummary& m : e.members->members())
      made.cut_off += is_valid(m.outcome) && is_censored(m.censoring);
  made.differences = differences(both[0].finished.scenario, both[1].finished.scenario);
  made.thickness_m = shared_thresholds(both);
  made.maps = request.out / "comparison.nc";
  observer.maps_begin();
  make_folder(request.out);
  forget_assets(request.out);
  write_maps(request, both, pairs, cancel, made);
  write_assets(request, both, pairs, cancel, made);
  return made;
}

}  // namespace sturz::workflow
