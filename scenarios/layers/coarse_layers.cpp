// SPDX-License-Identifier: Apache-2.0
#include "scenarios/layers/coarse_layers.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sturz {
namespace {

int factor_for(std::size_t n_cells, std::size_t max_cells) {
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(n_cells) /
                                                          static_cast<double>(max_cells)))));
}

/// Whether `now` is shown rather than `before`.
bool is_more_severe(const LayerMeaning& meaning, float now, float before) {
  if (is_arrival(meaning.quantity)) return now < before;
  if (meaning.statistic == Statistic::difference) return std::abs(now) > std::abs(before);
  return now > before;
}

/// Joins one plane into `to`, [coarse.n_rows][coarse.n_cols] of NaN.
void join_plane(const LayerSource& source, std::size_t layer, std::size_t plane, const Grid& coarse,
                int factor, float* to) {
  const Grid& fine = source.about().grid;
  const LayerMeaning& meaning = source.about().layers[layer].meaning;
  const int band = std::max(factor, 128 / factor * factor);
  std::vector<float> rows;
  for (int row0 = 0; row0 < fine.n_rows; row0 += band) {
    const Window w{row0, 0, std::min(band, fine.n_rows - row0), fine.n_cols};
    rows.resize(w.n_cells());
    source.read(layer, plane, w, rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const float v = rows[i];
      if (std::isnan(v)) continue;
      const int row = row0 + static_cast<int>(i / static_cast<std::size_t>(fine.n_cols));
      const int col = static_cast<int>(i % static_cast<std::size_t>(fine.n_cols));
      float& shown = to[coarse.index(row / factor, col / factor)];
      if (std::isnan(shown) || is_more_severe(meaning, v, shown)) shown = v;
    }
  }
}

}  // namespace

LayerStack coarse_layers(const LayerSource& source, std::size_t max_cells, CancelFlag cancel) {
  const LayerStack& about = source.about();
  const Grid& g = about.grid;
  LayerStack coarse;
  const int f = coarse.joined = factor_for(g.n_cells(), max_cells);
  coarse.attributes = about.attributes;
  coarse.grid = {
      (g.n_cols + f - 1) / f, (g.n_rows + f - 1) / f, g.west_m, g.north_m, f * g.cell_m, g.crs_wkt};
  for (std::size_t l = 0; l < about.layers.size(); ++l) {
    if (about.layers[l].is_count() || about.layers[l].meaning.is_bound()) continue;
    Layer layer = about.layers[l];
    layer.values.assign(layer.n_planes() * coarse.grid.n_cells(), nan_f);
    for (std::size_t plane = 0; plane < layer.n_planes(); ++plane) {
      cancel.check();
      join_plane(source, l, plane, coarse.grid, f,
                 layer.values.data() + plane * coarse.grid.n_cells());
    }
    coarse.layers.push_back(std::move(layer));
  }
  return coarse;
}

}  // namespace sturz
