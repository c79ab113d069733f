// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/map_scene.hpp"

#include "reports/figures/hillshade.hpp"
#include "reports/figures/legend.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr std::size_t max_cells = 500'000;

struct Box {
  double west, south, east, north;
};

/// The touched box widened by a sixth of its longer side, and to a shape between 1:1 and 5:3, so
/// that a narrow track is seen within its valley and fills a landscape page.
Box view_around(const Grid& g) {
  const double width = g.east_m() - g.west_m, height = g.north_m - g.south_m();
  const double margin = std::max(std::max(width, height) / 6, 6 * g.cell_m);
  double half_w = width / 2 + margin, half_h = height / 2 + margin;
  half_w = std::max(half_w, half_h);
  half_h = std::max(half_h, 0.6 * half_w);
  const double x = (g.west_m + g.east_m()) / 2, y = (g.north_m + g.south_m()) / 2;
  return {x - half_w, y - half_h, x + half_w, y + half_h};
}

int coarsening_for(std::size_t n_cells) {
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(n_cells) /
                                                          static_cast<double>(max_cells)))));
}

/// Means of f x f blocks of known elevations inside the box.
Raster<double> crop_ground(const Raster<double>& elevation, const Box& box) {
  const Grid& g = elevation.grid;
  const int col0 = std::clamp(g.col_of(box.west), 0, g.n_cols - 1);
  const int col1 = std::clamp(g.col_of(box.east), col0, g.n_cols - 1);
  const int row0 = std::clamp(g.row_of(box.north), 0, g.n_rows - 1);
  const int row1 = std::clamp(g.row_of(box.south), row0, g.n_rows - 1);
  const int cols = col1 - col0 + 1, rows = row1 - row0 + 1;
  const int f = coarsening_for(static_cast<std::size_t>(cols) * rows);
  Grid out{.n_cols = (cols + f - 1) / f,
           .n_rows = (rows + f - 1) / f,
           .west_m = g.west_m + col0 * g.cell_m,
           .north_m = g.north_m - row0 * g.cell_m,
           .cell_m = f * g.cell_m,
           .crs_wkt = g.crs_wkt};
  Raster<double> ground(out, nan_d);
  for (int r = 0; r < out.n_rows; ++r)
    for (int c = 0; c < out.n_cols; ++c) {
      double sum = 0;
      int known = 0;
      for (int row = row0 + r * f; row <= std::min(row1, row0 + r * f + f - 1); ++row)
        for (int col = col0 + c * f; col <= std::min(col1, col0 + c * f + f - 1); ++col)
          if (const double z = elevation.at(row, col); std::isfinite(z)) sum += z, ++known;
      if (known > 0) ground.at(r, c) = sum / known;
    }
  return ground;
}

}  // namespace

Window touched_window(const LayerStack& maps) {
  const Grid& g = maps.grid;
  int row0 = g.n_rows, row1 = -1, col0 = g.n_cols, col1 = -1;
  for (const Layer* layer : shown_layers(maps))
    for (std::size_t i = 0; i < layer->values.size(); ++i) {
      const float v = layer->values[i];
      if (!std::isfinite(v) || v == 0) continue;
      const std::size_t cell = i % g.n_cells();
      const int row = static_cast<int>(cell / g.n_cols), col = static_cast<int>(cell % g.n_cols);
      row0 = std::min(row0, row), row1 = std::max(row1, row);
      col0 = std::min(col0, col), col1 = std::max(col1, col);
    }
  if (row1 < 0) return {};
  return {row0, col0, row1 - row0 + 1, col1 - col0 + 1};
}

MapScene make_map_scene(const LayerStack& maps, const Raster<double>* elevation) {
  const Grid& g = maps.grid;
  MapScene scene;
  scene.window = touched_window(maps);
  if (scene.window.n_cells() == 0) scene.window = {0, 0, g.n_rows, g.n_cols};
  const Window& w = scene.window;
  const int f = scene.coarsening = coarsening_for(w.n_cells());
  scene.cells = {.n_cols = (w.n_cols + f - 1) / f,
                 .n_rows = (w.n_rows + f - 1) / f,
                 .west_m = g.west_m + w.col0 * g.cell_m,
                 .north_m = g.north_m - w.row0 * g.cell_m,
                 .cell_m = f * g.cell_m,
                 .crs_wkt = g.crs_wkt};
  const Box box = view_around(scene.cells);
  if (elevation != nullptr && elevation->grid.n_cells() > 0) {
    scene.ground = crop_ground(*elevation, box);
  } else {
    Grid plain = scene.cells;
    plain.west_m = box.west, plain.north_m = box.north;
    plain.n_cols = static_cast<int>(std::ceil((box.east - box.west) / plain.cell_m));
    plain.n_rows = static_cast<int>(std::ceil((box.north - box.south) / plain.cell_m));
    scene.ground = Raster<double>(plain, nan_d);
  }
  scene.shade = hillshade(scene.ground);
  return scene;
}

std::vector<float> scene_plane(const MapScene& scene, const Layer& layer, std::size_t plane,
                               const Grid& results) {
  const Window& w = scene.window;
  const bool smallest = is_arrival(layer.meaning.quantity);
  std::vector<float> out(scene.cells.n_cells(), nan_f);
  const float* values = layer.values.data() + plane * results.n_cells();
  for (int row = 0; row < w.n_rows; ++row)
    for (int col = 0; col < w.n_cols; ++col) {
      const float v = values[results.index(w.row0 + row, w.col0 + col)];
      float& shown = out[scene.cells.index(row / scene.coarsening, col / scene.coarsening)];
      if (std::isnan(v)) continue;
      if (std::isnan(shown) || (smallest ? v < shown : v > shown)) shown = v;
    }
  return out;
}

}  // namespace sturz
