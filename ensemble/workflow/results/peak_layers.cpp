// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/peak_layers.hpp"

#include "engine/simulation/member_parts.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/known_ground.hpp"
#include "ensemble/hazard/map_units.hpp"

#include <cmath>

namespace sturz::workflow {
namespace {

/// Of one layer, over `extent`.
std::vector<float> values_of(const MemberResult& result, PeakLayer peak, const Window& extent,
                             const KnownGround& ground) {
  const Window& w = result.window;
  const std::vector<float>& from = result.layer(peak);
  const double factor = map_unit(peak).per_si;
  std::vector<float> values;
  values.reserve(extent.n_cells());
  for (int row = extent.row0; row < end_row(extent); ++row)
    for (int col = extent.col0; col < end_col(extent); ++col) {
      const bool mine =
          row >= w.row0 && row < end_row(w) && col >= w.col0 && col < end_col(w) && !from.empty();
      const std::size_t i =
          mine ? static_cast<std::size_t>(row - w.row0) * static_cast<std::size_t>(w.n_cols) +
                     static_cast<std::size_t>(col - w.col0)
               : 0;
      const float v = mine ? from[i] : info(peak).untouched;
      const bool came = mine && (v > 0 || !std::isnan(result.layer(PeakLayer::arrival)[i]));
      values.push_back(came || ground.at(row, col) ? static_cast<float>(factor * v) : nan_f);
    }
  return values;
}

}  // namespace

Grid map_grid(const MemberResult& result) {
  return grid_of(map_extent(result.window, result.grid), result.grid);
}

LayerStack peak_layers(const MemberResult& result, const Raster<double>* ground,
                       const Grid& whole_ground) {
  LayerStack stack;
  const Window extent = map_extent(result.window, result.grid);
  stack.grid = map_grid(result);
  for (int i = 0; i < n_peak_layers; ++i) {
    const auto peak = static_cast<PeakLayer>(i);
    // What not every scene has.
    const bool optional =
        peak == PeakLayer::left || peak == PeakLayer::eroded || is_of_materials(peak);
    if (optional && result.layer(peak).empty()) continue;
    Layer layer;
    layer.name = info(peak).name;
    layer.meaning = {quantity_of(peak), Statistic::peak};
    layer.long_name = info(peak).long_name;
    layer.units = map_unit(peak).name;
    layer.comment = std::isnan(info(peak).untouched)
                        ? "missing where the flow never came"
                        : "0 where the flow never came; missing where the ground is not known";
    layer.values = values_of(result, peak, extent, KnownGround(ground, whole_ground, result.grid));
    stack.layers.push_back(std::move(layer));
  }
  return stack;
}

}  // namespace sturz::workflow
