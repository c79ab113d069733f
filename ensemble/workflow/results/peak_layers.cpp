// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/peak_layers.hpp"

#include <cmath>

namespace sturz::workflow {

LayerStack peak_layers(const MemberResult& result) {
  LayerStack stack;
  stack.grid = result.grid;
  const Window& w = result.window;
  const auto& arrival = result.layer(PeakLayer::arrival);
  for (int i = 0; i < n_peak_layers; ++i) {
    const auto& values = result.layers[i];
    if (values.empty() && static_cast<PeakLayer>(i) == PeakLayer::left) continue;
    Layer layer;
    const auto peak = static_cast<PeakLayer>(i);
    layer.name = info(peak).name;
    layer.meaning = {quantity_of(peak), Statistic::peak};
    layer.long_name = info(peak).long_name;
    layer.units = info(peak).units;
    layer.comment = "missing where the flow never came";
    layer.values.assign(stack.grid.n_cells(), nan_f);
    for (int row = 0; row < w.n_rows && !values.empty(); ++row)
      for (int col = 0; col < w.n_cols; ++col) {
        const std::size_t from = static_cast<std::size_t>(row) * w.n_cols + col;
        const bool left = peak == PeakLayer::left && values[from] > 0;
        if (left || !std::isnan(arrival[from]))
          layer.values[stack.grid.index(w.row0 + row, w.col0 + col)] = values[from];
      }
    stack.layers.push_back(std::move(layer));
  }
  return stack;
}

}  // namespace sturz::workflow
