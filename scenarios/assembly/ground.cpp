// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/ground.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

NodataRule rule_of(const Scenario& s) {
  return s.terrain.nodata == TerrainEdge::wall ? NodataRule::wall : NodataRule::outflow;
}

/// A margin of repeated ground, so that the surface exists up to the period's edge.
std::shared_ptr<const Raster<double>> with_margin(const Raster<double>& z, const Domain& d) {
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

Terrain averaged(const Scenario& s, const SceneInputs& in, int factor) {
  return {std::make_shared<const Raster<double>>(coarsened(*in.elevation, factor)), rule_of(s)};
}

}  // namespace

int column_ground_factor(const Scenario& s, const SceneInputs& in) {
  if (!s.domain.periodic.empty()) return 1;
  const Grid& g = in.elevation->grid;
  // At least 8 x 8 cells are left of a small ground.
  const int most = std::max(1, std::min(g.n_cols, g.n_rows) / 8);
  // A hair more than the quotient: 0.6/0.2 is under three.
  return std::clamp(static_cast<int>(s.numerics.spacing_m / g.cell_m * (1 + 1e-9)), 1, most);
}

Raster<double> coarsened(const Raster<double>& z, int factor) {
  Grid g = z.grid;
  g.n_cols /= factor;
  g.n_rows /= factor;
  g.cell_m *= factor;
  Raster<double> out(g);
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) {
      double sum = 0;
      for (int j = 0; j < factor; ++j)
        for (int i = 0; i < factor; ++i) sum += z.at(r * factor + j, c * factor + i);
      out.at(r, c) = sum / (factor * factor);
    }
  return out;
}

Terrain scene_ground(const Scenario& s, const SceneInputs& in, const Domain& domain,
                     bool for_columns) {
  const int factor = for_columns ? column_ground_factor(s, in) : 1;
  const auto& prepared = factor > 1 ? in.column_ground : in.ground;
  if (prepared && prepared->grid().cell_m == factor * in.elevation->grid.cell_m) return *prepared;
  if (factor > 1) return averaged(s, in, factor);
  const bool periodic = domain.x.active || domain.y.active;
  return {periodic ? with_margin(*in.elevation, domain) : in.elevation, rule_of(s)};
}

void prepare_grounds(const Scenario& s, SceneInputs& in) {
  if (!s.domain.periodic.empty()) return;
  in.ground = std::make_shared<const Terrain>(in.elevation, rule_of(s));
  const int factor = column_ground_factor(s, in);
  if (factor > 1) in.column_ground = std::make_shared<const Terrain>(averaged(s, in, factor));
}

}  // namespace sturz
