// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/structures/column_ground.hpp"

#include "scenarios/assembly/ground.hpp"
#include "scenarios/assembly/structures/dams.hpp"
#include "scenarios/scene_inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace sturz {
namespace {

/// Rounds of raising the crest; each leaves less than half of what was missing.
constexpr int crest_rounds = 6;

/// What rounding takes off the crest is added to the nodes that carry it.
void mend_crest(const DamLine& line, const DamSpec& spec, double width, Raster<double>& nodes) {
  const Grid& g = nodes.grid;
  const std::vector<double> crest = crest_of(line, spec);
  for (int round = 0; round < crest_rounds; ++round) {
    std::map<std::pair<int, int>, double> missing;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const Vec2& p = line.points[i];
      const double lack = crest[i] - rounded(nodes, p.x(), p.y());
      if (!(lack > 0)) continue;
      const int reach = static_cast<int>(std::ceil(0.5 * width / g.cell_m)) + 1;
      const int row = g.row_of(p.y()), col = g.col_of(p.x());
      for (int r = row - reach; r <= row + reach; ++r)
        for (int c = col - reach; c <= col + reach; ++c) {
          if (!g.contains(r, c)) continue;
          const double d = std::hypot(g.x_center(c) - p.x(), g.y_center(r) - p.y());
          if (d > 0.5 * width) continue;
          double& most = missing[{r, c}];
          most = std::max(most, lack);
        }
    }
    if (missing.empty()) return;
    for (const auto& [at, lack] : missing) nodes.at(at.first, at.second) += lack;
  }
}

/// All the averaged ground around the dams: as it is, and with them.
struct Site {
  Raster<double> before, nodes;
};
Site site_of(const Scenario& s, const SceneInputs& in, int factor) {
  const GroundStructures& structures = in.structures;
  Raster<double> fine = structures.site;
  raise_dams(structures, s.terrain.dams, WhichDams::all, fine);
  Site site;
  site.nodes = coarsened(fine, in.terrain_grid(), factor);
  site.before = site.nodes;
  for (const DamLine& line : structures.dams) {
    const DamSpec& spec = s.terrain.dams[line.dam];
    const double width = standing_width(spec, site.nodes.grid.cell_m);
    raise_dam(line, spec, width, site.nodes);
    mend_crest(line, spec, width, site.nodes);
  }
  return site;
}

/// Cells of the averaged ground that dams raise.
void stand_dams(const Scenario& s, const SceneInputs& in, int factor, Raster<double>& averaged) {
  const auto [before, nodes] = site_of(s, in, factor);
  const Grid whole = coarse_grid(in.terrain_grid(), factor);
  const Window from = window_of(nodes.grid, whole), to = window_of(averaged.grid, whole);
  for (int r = 0; r < from.n_rows; ++r)
    for (int c = 0; c < from.n_cols; ++c) {
      const int row = from.row0 + r, col = from.col0 + c;
      if (!to.contains(row, col) || !(nodes.at(r, c) > before.at(r, c))) continue;
      double& z = averaged.at(row - to.row0, col - to.col0);
      z = std::max(z, nodes.at(r, c));
    }
}

/// Covered cells of each averaged cell that has some.
struct Covered {
  int n = 0;
  double roofs = 0;  ///< sum of their elevations [m]
};
using CoveredCells = std::map<std::size_t, Covered>;

/// Index of the averaged cell that holds a held one; none at an edge where blocks are cut.
std::optional<std::size_t> block_of(std::size_t cell, const Window& held, int factor,
                                    const Window& blocks) {
  const auto n = static_cast<std::size_t>(held.n_cols);
  const int row = (held.row0 + static_cast<int>(cell / n)) / factor;
  const int col = (held.col0 + static_cast<int>(cell % n)) / factor;
  if (!blocks.contains(row, col)) return std::nullopt;
  return static_cast<std::size_t>(row - blocks.row0) * blocks.n_cols + (col - blocks.col0);
}

void stand_buildings(const SceneInputs& in, int factor, const Raster<double>& fine,
                     Raster<double>& averaged) {
  const Grid& whole = in.terrain_grid();
  const Window held = window_of(fine.grid, whole),
               blocks = window_of(averaged.grid, coarse_grid(whole, factor));
  CoveredCells covered;
  for (const RaisedCell& cell : in.structures.buildings)
    if (const auto block = block_of(cell.cell, held, factor, blocks)) {
      Covered& sum = covered[*block];
      ++sum.n, sum.roofs += fine.values[cell.cell];
    }
  const int all = factor * factor;
  for (const auto& [block, sum] : covered) {
    double& z = averaged.values[block];
    if (2 * sum.n >= all)
      z = sum.roofs / sum.n;
    else
      z = (z * all - sum.roofs) / (all - sum.n);
  }
}

}  // namespace

double rounded(const Raster<double>& nodes, double x, double y) {
  const Grid& g = nodes.grid;
  const double u = (x - g.west_m) / g.cell_m - 0.5, v = (g.north_m - y) / g.cell_m - 0.5;
  const double col = std::floor(u + 0.5), row = std::floor(v + 0.5);
  if (!(row >= 1 && col >= 1 && row < g.n_rows - 1 && col < g.n_cols - 1)) return nan_d;
  const auto weights = [](double t) {
    return std::array<double, 3>{0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t,
                                 0.5 * (0.5 + t) * (0.5 + t)};
  };
  const auto east = weights(u - col), south = weights(v - row);
  double z = 0;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      z += south[r] * east[c] *
           nodes.at(static_cast<int>(row) + static_cast<int>(r) - 1,
                    static_cast<int>(col) + static_cast<int>(c) - 1);
  return z;
}

void stand_on_columns_ground(const Scenario& s, const SceneInputs& in, int factor,
                             const Raster<double>& fine, Raster<double>& averaged) {
  if (factor > 1) stand_buildings(in, factor, fine, averaged);
  if (!in.structures.dams.empty()) stand_dams(s, in, factor, averaged);
}

CrestLack crest_lack(const Scenario& s, const SceneInputs& in, int factor) {
  CrestLack most;
  if (in.structures.dams.empty()) return most;
  const Site site = site_of(s, in, factor);
  for (const DamLine& line : in.structures.dams) {
    const std::vector<double> crest = crest_of(line, s.terrain.dams[line.dam]);
    for (std::size_t i = 0; i < crest.size(); ++i) {
      const double height = crest[i] - line.ground_m[i];
      const double lack = crest[i] - rounded(site.nodes, line.points[i].x(), line.points[i].y());
      if (height > 0 && lack > most.share * height) most = {lack / height, line.name};
    }
  }
  return most;
}

int lost_buildings(const SceneInputs& in, int factor) {
  if (factor <= 1) return 0;
  const Grid& whole = in.terrain_grid();
  const Window held = in.held(), blocks = whole_of(coarse_grid(whole, factor));
  std::map<std::size_t, int> covered;
  for (const RaisedCell& cell : in.structures.buildings)
    if (const auto block = block_of(cell.cell, held, factor, blocks)) ++covered[*block];
  std::set<int> all, kept;
  for (const RaisedCell& cell : in.structures.buildings) {
    all.insert(cell.building);
    const auto block = block_of(cell.cell, held, factor, blocks);
    if (block && 2 * covered[*block] >= factor * factor) kept.insert(cell.building);
  }
  return static_cast<int>(all.size() - kept.size());
}

}  // namespace sturz
