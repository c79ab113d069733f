// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/risk/risk.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/risk/asset_rates.hpp"
#include "ensemble/risk/rate_maps.hpp"
#include "ensemble/workflow/folder/opened_ensemble.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/results/map_files.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/features/feature_file.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "io/risk/risk_file.hpp"
#include "io/site/map_ground.hpp"
#include "scenarios/layers/coarse_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

std::vector<OpenedEnsemble> open_all(const RiskSpec& spec, const fs::path& directory,
                                     Observer& observer, CancelFlag cancel) {
  std::vector<OpenedEnsemble> all;
  for (const RiskScenario& s : spec.scenarios) {
    const fs::path folder(s.folder);
    all.push_back(
        open_ensemble(folder.is_absolute() ? folder : directory / folder, observer, cancel));
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      require(!fs::equivalent(all[i].finished.folder.root, all.back().finished.folder.root),
              fmt::format("{} and {} are one folder (its events would count twice). Name it once, "
                          "with both frequencies added up.",
                          spec.scenarios[i].folder, s.folder));
  }
  return all;
}

RateContext context_of(const RiskSpec& spec, const std::vector<OpenedEnsemble>& all) {
  RateContext context;
  context.attributes = {{"title", "Landslide hazard by year"},
                        {"source", fmt::format("sturz {} ({})", version, git_commit)}};
  for (std::size_t i = 0; i < all.size(); ++i)
    context.attributes.emplace_back(
        fmt::format("scenario_{}", i + 1),
        fmt::format("{}: {:g} a year, maps {}", spec.scenarios[i].folder,
                    spec.scenarios[i].frequency_per_year, all[i].finished.manifest.hazard_hash));
  return context;
}

void write_maps(const RiskSpec& spec, const std::vector<OpenedEnsemble>& all, const fs::path& out,
                CancelFlag cancel, RiskMade& made) {
  std::vector<const MemberParts*> sources;
  for (const OpenedEnsemble& e : all) sources.push_back(e.members.get());
  const JoinedMembers members(std::move(sources));
  const Grid& grid = members.grid();
  const OpenedEnsemble& first = all.front();
  const SceneInputs& inputs = *first.finished.inputs;
  const auto ground =
      ground_of_map(first.finished.scenario, inputs,
                    grid_of(map_extent(MemberCells(members).touched(), grid), grid));
  RateContext context = context_of(spec, all);
  context.memory_bytes = records_memory_bytes();
  context.ground = ground.get();
  context.whole_ground = inputs.terrain_grid();
  context.cancel = cancel;
  LayersFileWriter file(made.maps);
  make_rate_maps(members, spec, context, file);
  cancel.check();
  file.commit();
  const LayersFileReader maps(made.maps);
  const LayerStack coarse = coarse_layers(maps, page_cells, cancel);
  write_map_files(out / "risk", maps, coarse, cancel);
  if (const Layer* rate = coarse.find("annual_rate"))
    for (const float v : rate->values)
      if (std::isfinite(v)) made.highest_rate = std::max(made.highest_rate, static_cast<double>(v));
}

fs::path asset_csv(const fs::path& out) { return out / "assets_by_year.csv"; }
fs::path asset_gpkg(const fs::path& out) { return out / "assets_by_year.gpkg"; }

/// They belong to the maps that were there.
void forget_assets(const fs::path& out) {
  fs::remove(asset_csv(out));
  fs::remove(asset_gpkg(out));
}

void write_assets(const RiskSpec& spec, const std::vector<OpenedEnsemble>& all, const fs::path& out,
                  CancelFlag cancel, RiskMade& made) {
  const auto assets = common_assets(all);
  if (assets == nullptr) return;
  std::vector<ScenarioAtAssets> scenarios;
  for (const OpenedEnsemble& e : all) {
    AssetHits hits = find_hits(*e.members, *assets, cancel);
    RiskTable risk = assess_assets(*assets, hits);
    scenarios.push_back({std::move(hits), std::move(risk)});
  }
  const RateTable table = assess_rates(*assets, spec, scenarios);
  const FeatureTable features =
      rate_features(*assets, spec, table, all.front().members->grid().crs_wkt);
  write_text_atomic(asset_csv(out), to_csv(features));
  write_geopackage(asset_gpkg(out), features);
  made.assets_csv = asset_csv(out);
  made.n_assets = assets->list.size();
  made.value_unit = assets->value_unit;
  made.total_loss = table.total_loss;
  made.n_without_loss = table.n_without_loss;
}

}  // namespace

RiskMade make_risk(const RiskRequest& request, Observer& observer, CancelFlag cancel) {
  const RiskSpec spec = read_risk(request.file);
  require_free_of_results(request.out);
  const std::vector<OpenedEnsemble> all =
      open_all(spec, request.file.parent_path(), observer, cancel);
  require_same_maps(all);
  common_assets(all);  // what is wrong is said before anything is written
  RiskMade made;
  made.return_periods_years = spec.return_periods_years;
  for (std::size_t i = 0; i < all.size(); ++i) {
    RiskMade::Scenario s{spec.scenarios[i].folder, spec.scenarios[i].frequency_per_year, 0, 0};
    for (const MemberSummary& m : all[i].members->members()) {
      s.valid += is_valid(m.outcome);
      s.cut_off += is_valid(m.outcome) && is_censored(m.censoring);
    }
    made.scenarios.push_back(std::move(s));
  }
  observer.maps_begin();
  make_folder(request.out);
  made.maps = request.out / "risk.nc";
  forget_assets(request.out);
  write_maps(spec, all, request.out, cancel, made);
  write_assets(spec, all, request.out, cancel, made);
  return made;
}

}  // namespace sturz::workflow
