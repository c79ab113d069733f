// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/ground.hpp"

#include "scenarios/assembly/structures/column_ground.hpp"
#include "scenarios/assembly/structures/dams.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

NodataRule rule_of(const Scenario& s) {
  return s.terrain.nodata == TerrainEdge::wall ? NodataRule::wall : NodataRule::outflow;
}

/// A margin of repeated ground, so that the surface exists up to the period's edge.
std::shared_ptr<const Raster<double>> with_repeats(const Raster<double>& z, const Domain& d) {
  const int mx = d.x.active ? 2 : 0, my = d.y.active ? 2 : 0;
  Grid g = z.grid;
  g.west_m -= mx * g.cell_m;
  g.north_m += my * g.cell_m;
  g.n_cols += 2 * mx;
  g.n_rows += 2 * my;
  auto out = std::make_shared<Raster<double>>(g);
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) {
      const int rr = r - my, cc = c - mx;
      const int row = (rr + z.grid.n_rows) % z.grid.n_rows,
                col = (cc + z.grid.n_cols) % z.grid.n_cols;
      double shift = 0;
      if (cc < 0) shift -= d.x.rise;
      if (cc >= z.grid.n_cols) shift += d.x.rise;
      if (rr >= z.grid.n_rows) shift -= d.y.rise;  // rows run southward
      if (rr < 0) shift += d.y.rise;
      out->at(r, c) = z.at(row, col) + shift;
    }
  return out;
}

/// Also the lowest elevation is one of the scene, not of the part that is held.
std::shared_ptr<const HeldGround> held_ground(const SceneInputs& in, const Grid& whole,
                                              std::shared_ptr<const Raster<double>> part) {
  std::optional<double> lowest;
  if (in.reach) lowest = in.reach->lowest_m;
  return std::make_shared<const HeldGround>(whole, std::move(part), lowest);
}

/// With the dams that each member raises by itself.
std::shared_ptr<const Raster<double>> elevation_of(const Scenario& s, const SceneInputs& in) {
  if (!in.structures.any_by_member()) return in.elevation;
  auto own = std::make_shared<Raster<double>>(*in.elevation);
  raise_dams(in.structures, s.terrain.dams, WhichDams::by_member, *own);
  return own;
}

Terrain fine(const Scenario& s, const SceneInputs& in) {
  return {held_ground(in, in.terrain_grid(), elevation_of(s, in)), rule_of(s)};
}

/// Columns have a ground of their own where it is averaged, or a dam keeps its crest under
/// rounding.
bool has_column_ground(const SceneInputs& in, int factor) {
  return factor > 1 || !in.structures.dams.empty();
}

Terrain averaged(const Scenario& s, const SceneInputs& in, int factor) {
  const Grid& whole = in.terrain_grid();
  const auto elevation = elevation_of(s, in);
  Raster<double> mean = coarsened(*elevation, whole, factor);
  if (in.structures.any()) stand_on_columns_ground(s, in, factor, *elevation, mean);
  auto part = std::make_shared<const Raster<double>>(std::move(mean));
  return {held_ground(in, coarse_grid(whole, factor), std::move(part)), rule_of(s)};
}

}  // namespace

int column_ground_factor(const Scenario& s, const SceneInputs& in) {
  if (!s.domain.periodic.empty()) return 1;
  const Grid& g = in.terrain_grid();
  // At least 8 x 8 cells are left of a small ground.
  const int most = std::max(1, std::min(g.n_cols, g.n_rows) / 8);
  // A hair more than the quotient: 0.6/0.2 is under three.
  return std::clamp(static_cast<int>(s.numerics.spacing_m / g.cell_m * (1 + 1e-9)), 1, most);
}

Grid coarse_grid(const Grid& whole, int factor) {
  Grid g = whole;
  g.n_cols /= factor;
  g.n_rows /= factor;
  g.cell_m *= factor;
  return g;
}

Raster<double> coarsened(const Raster<double>& z, int factor) {
  return coarsened(z, z.grid, factor);
}

Raster<double> coarsened(const Raster<double>& part, const Grid& whole, int factor) {
  const Grid coarse = coarse_grid(whole, factor);
  const Window held = window_of(part.grid, whole);
  const auto up = [&](int n) { return (n + factor - 1) / factor; };
  const Window w = window_between(up(held.row0), held.end_row() / factor, up(held.col0),
                                  held.end_col() / factor, coarse);
  Raster<double> out(grid_of(w, coarse));
  for (int r = 0; r < w.n_rows; ++r)
    for (int c = 0; c < w.n_cols; ++c) {
      const int row = (w.row0 + r) * factor - held.row0, col = (w.col0 + c) * factor - held.col0;
      double sum = 0;
      for (int j = 0; j < factor; ++j)
        for (int i = 0; i < factor; ++i) sum += part.at(row + j, col + i);
      out.at(r, c) = sum / (factor * factor);
    }
  return out;
}

Terrain scene_ground(const Scenario& s, const SceneInputs& in, const Domain& domain,
                     bool for_columns) {
  const int factor = for_columns ? column_ground_factor(s, in) : 1;
  const bool own = for_columns && has_column_ground(in, factor);
  const auto& prepared = own ? in.column_ground : in.ground;
  if (prepared && prepared->grid().cell_m == factor * in.elevation->grid.cell_m) return *prepared;
  if (own) return averaged(s, in, factor);
  const bool periodic = domain.x.active || domain.y.active;
  if (!periodic) return fine(s, in);
  return {with_repeats(*in.elevation, domain), rule_of(s)};
}

void prepare_grounds(const Scenario& s, SceneInputs& in) {
  if (!s.domain.periodic.empty() || in.structures.any_by_member()) return;
  in.ground = std::make_shared<const Terrain>(fine(s, in));
  const int factor = column_ground_factor(s, in);
  if (has_column_ground(in, factor))
    in.column_ground = std::make_shared<const Terrain>(averaged(s, in, factor));
}

}  // namespace sturz
