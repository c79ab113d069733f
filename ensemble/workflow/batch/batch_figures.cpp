// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/batch_figures.hpp"

#include "engine/core/error.hpp"
#include "ensemble/censoring/scalar_censoring.hpp"
#include "ensemble/workflow/folder/finished_folder.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/results/asset_files.hpp"
#include "io/members/member_store.hpp"
#include "io/netcdf/netcdf_layers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

constexpr std::array<double, 3> runout_levels{0.05, 0.5, 0.95};
constexpr double confidence = 0.95;

MemberStore members_in(const FinishedFolder& finished, CancelFlag cancel) {
  if (finished.manifest.kind == "run") return MemberStore(finished.folder.members(), {}, cancel);
  const DesignTable design = saved_design(finished.folder, finished.manifest, finished.scenario);
  return members_of(finished.folder, finished.manifest, design, {}, cancel);
}

void add_members(BatchFigures& figures, const std::vector<MemberSummary>& members) {
  figures.finished = static_cast<std::int64_t>(members.size());
  for (const MemberSummary& m : members) {
    figures.core_s += m.scalars.cpu_s;
    if (!is_valid(m.outcome)) continue;
    ++figures.valid;
    if (m.censoring != Censoring::none) ++figures.censored;
  }
  const auto runouts = observations(members, &MemberScalars::runout_m);
  for (std::size_t i = 0; i < runout_levels.size(); ++i) {
    const CensoredEstimate estimate = censored_quantile(runouts, runout_levels[i], confidence);
    figures.runout_m[i] = estimate.value;
    figures.at_least[i] = estimate.at_least;
  }
}

void add_areas(BatchFigures& figures, const Raster<float>& probability) {
  const double cell_m2 = probability.grid.cell_m * probability.grid.cell_m;
  for (std::size_t i = 0; i < outline_levels.size(); ++i) {
    const Raster<std::uint8_t> cells = cells_reached(probability, outline_levels[i]);
    figures.area_m2[i] =
        cell_m2 * static_cast<double>(std::count(cells.values.begin(), cells.values.end(), 1));
  }
}

/// The layer of reached cells, or of a single run the first arrival.
const Layer* layer_of(const LayerStack& about, bool single_run) {
  const LayerMeaning wanted =
      single_run ? LayerMeaning{Quantity::arrival, Statistic::peak, IntensityClass::none}
                 : LayerMeaning{Quantity::reached, Statistic::probability, IntensityClass::none};
  for (const Layer& layer : about.layers)
    if (layer.meaning == wanted) return &layer;
  return nullptr;
}

}  // namespace

std::string level_text(double level) {
  return level > 0 ? fmt::format("{:g}", level) : std::string("any");
}

Raster<float> reached_map(const fs::path& root) {
  const OutputFolder folder{root};
  const bool single_run = Manifest::read(folder.manifest()).kind == "run";
  const fs::path file = single_run ? folder.peaks_nc() : folder.hazard_nc();
  const LayersFileReader maps(file);
  const Layer* layer = layer_of(maps.about(), single_run);
  require(layer != nullptr,
          fmt::format("{} has no map of what was reached (another program wrote it). Compute it "
                      "again.",
                      file.string()));
  Raster<float> found(maps.about().grid);
  maps.read(static_cast<std::size_t>(layer - maps.about().layers.data()), 0, whole_of(found.grid),
            found.values);
  if (single_run)
    for (float& value : found.values) value = std::isnan(value) ? 0.0F : 1.0F;
  return found;
}

Raster<std::uint8_t> cells_reached(const Raster<float>& probability, double level) {
  constexpr double rounding = 1e-6;  // probabilities are kept as floats
  Raster<std::uint8_t> cells(probability.grid);
  for (std::size_t i = 0; i < cells.values.size(); ++i) {
    const double p = probability.values[i];
    cells.values[i] = p > 0 && p >= level - rounding ? 1 : 0;
  }
  return cells;
}

BatchFigures figures_of(const fs::path& root, Observer& observer, CancelFlag cancel) {
  const FinishedFolder finished = open_finished(root, observer);
  const MemberStore store = members_in(finished, cancel);
  BatchFigures figures;
  figures.planned = finished.manifest.members;
  figures.hazard_hash = finished.manifest.hazard_hash;
  add_members(figures, store.members());
  if (figures.valid > 0) add_areas(figures, reached_map(root));
  if (finished.inputs != nullptr && figures.valid > 0)
    if (const auto risk = find_risk(store, *finished.inputs, cancel))
      for (std::size_t i = 0; i < risk->assets->list.size(); ++i)
        figures.assets.push_back({risk->assets->list[i].name, risk->risk.rows[i].probability});
  return figures;
}

}  // namespace sturz::workflow
