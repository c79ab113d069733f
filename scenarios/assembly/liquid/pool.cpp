// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/liquid/pool.hpp"

#include "engine/core/error.hpp"
#include "engine/core/sum.hpp"
#include "engine/core/vec.hpp"
#include "scenarios/assembly/formulation.hpp"
#include "scenarios/assembly/reach.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace sturz {
namespace {

using Ring = std::vector<Vec2>;

/// In front of an upright wall [m].
double ahead_of(const WallSpec& wall, double x, double y) {
  const double n = std::hypot(wall.normal[0], wall.normal[1]);
  return ((x - wall.point_m[0]) * wall.normal[0] + (y - wall.point_m[1]) * wall.normal[1]) / n;
}

double area_of(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * std::abs(twice);
}

/// What of a convex ring lies in front of a wall.
Ring cut(const Ring& ring, const WallSpec& wall) {
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double da = ahead_of(wall, a.x(), a.y()), db = ahead_of(wall, b.x(), b.y());
    if (da >= 0) kept.push_back(a);
    if ((da < 0) != (db < 0)) kept.emplace_back(a + da / (da - db) * (b - a));
  }
  return kept;
}

/// Share of a cell in front of all walls.
double share_before(const std::vector<WallSpec>& walls, double x, double y, double cell) {
  const double half = 0.5 * cell;
  Ring ring;
  for (const WallSpec& wall : walls) {
    const double d = ahead_of(wall, x, y);
    if (d >= cell) continue;
    if (d <= -cell) return 0;
    if (ring.empty())
      ring = {
          {x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}};
    ring = cut(ring, wall);
    if (ring.size() < 3) return 0;
  }
  return ring.empty() ? 1 : std::min(1.0, area_of(ring) / (cell * cell));
}

/// What the outline leaves to it, walls aside.
double outlined(const SceneInputs& in, int row, int col) {
  if (!in.pool) return 1;
  const Window at = window_of(in.pool->grid, in.terrain_grid());
  return at.contains(row, col) ? in.pool->at(row - at.row0, col - at.col0) : 0;
}

Raster<double> shares(const Scenario& s, const SceneInputs& in) {
  const Window at = pool_window(in);
  Raster<double> share(grid_of(at, in.terrain_grid()), 0.0);
  const Grid& g = share.grid;
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c)
      if (const double own = outlined(in, at.row0 + r, at.col0 + c); own > 0)
        share.at(r, c) = own * share_before(s.domain.walls, g.x_center(c), g.y_center(r), g.cell_m);
  return share;
}

/// Elevation of a cell of the working grid; NaN where nothing is known [m].
using GroundAt = std::function<double(int row, int col)>;

constexpr std::array<std::pair<int, int>, 4> beside{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

/// Where cells with water end without ground that holds it.
struct Ends {
  double open_m = 0;      ///< ground below the surface beyond the outline
  std::size_t n_end = 0;  ///< sides of cells at the end of the known ground
  int row = 0, col = 0;   ///< of the first of them
};

Ends ends_of(const Scenario& s, const SceneInputs& in, const Pool& pool, const GroundAt& ground) {
  const Grid& whole = in.terrain_grid();
  const Window at = window_of(pool.share.grid, whole);
  const auto& periodic = s.domain.periodic;
  const auto repeats = [&](const char* direction) {
    return std::find(periodic.begin(), periodic.end(), direction) != periodic.end();
  };
  const bool along_x = repeats("x"), along_y = repeats("y");
  Ends ends;
  for (int r = at.row0; r < at.end_row(); ++r)
    for (int c = at.col0; c < at.end_col(); ++c) {
      if (!(pool.share.at(r - at.row0, c - at.col0) > 0) || !(ground(r, c) < pool.surface_m))
        continue;
      for (const auto& [dr, dc] : beside) {
        const int row = r + dr, col = c + dc;
        if (dc == 0 ? along_y : along_x) continue;
        const double cell = whole.cell_m, x = whole.x_center(col), y = whole.y_center(row);
        if (share_before(s.domain.walls, x, y, cell) <= 0) continue;
        const double z = whole.contains(row, col) ? ground(row, col) : nan_d;
        if (std::isnan(z)) {
          if (ends.n_end++ == 0) ends.row = r, ends.col = c;
        } else if (outlined(in, row, col) <= 0 && z < pool.surface_m) {
          ends.open_m += cell;
        }
      }
    }
  return ends;
}

Pool filled(const Scenario& s, const SceneInputs& in, const GroundAt& ground, double surface_m) {
  Pool pool;
  pool.surface_m = surface_m;
  pool.share = shares(s, in);
  const Grid& g = pool.share.grid;
  const Window at = window_of(g, in.terrain_grid());
  Sum volume, area;
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) {
      const double share = pool.share.at(r, c);
      if (!(share > 0)) continue;
      const double depth = surface_m - ground(at.row0 + r, at.col0 + c);
      if (!(depth > 0)) continue;
      volume.add(share * depth);
      area.add(share);
      pool.deepest_m = std::max(pool.deepest_m, depth);
    }
  const double cell_area = g.cell_m * g.cell_m;
  pool.volume_m3 = volume.value() * cell_area;
  pool.area_m2 = area.value() * cell_area;
  return pool;
}

std::string level_text(double surface_m) {
  return "fluid.pool.surface_m = " + number_text(surface_m);
}

void require_water(const Scenario& s, const Pool& pool, const GroundAt& ground,
                   const SceneInputs& in) {
  double lowest = std::numeric_limits<double>::infinity();
  const Window at = window_of(pool.share.grid, in.terrain_grid());
  for (int r = at.row0; r < at.end_row(); ++r)
    for (int c = at.col0; c < at.end_col(); ++c)
      if (pool.share.at(r - at.row0, c - at.col0) > 0) lowest = std::fmin(lowest, ground(r, c));
  require(std::isfinite(lowest),
          pool_key(*s.fluid->pool) +
              " (no ground is known there in front of the walls, so nothing can be filled). Move "
              "the pool.");
  require(pool.deepest_m > 0,
          level_text(pool.surface_m) + " (the ground there lies at " + short_number(lowest) +
              " m and higher: the level is below the bed, and there is no water). Raise it, or "
              "move the pool.");
  const double layers = pool.deepest_m / s.numerics.spacing_m;
  require(layers >= unresolved_layers || s.numerics.accept_unresolved,
          level_text(pool.surface_m) + " (" + short_number(layers) +
              " layers of particles where the water is deepest, fewer than 2: the terrain has no "
              "depth for it). Raise it, use a numerics.spacing_m below " +
              short_number(pool.deepest_m / unresolved_layers) +
              " m, or accept it with numerics.accept_unresolved: true.");
}

void require_shore(const Scenario& s, const SceneInputs& in, const Pool& pool,
                   const GroundAt& ground) {
  if (s.terrain.nodata == TerrainEdge::wall) return;
  const Ends ends = ends_of(s, in, pool, ground);
  const Grid& g = in.terrain_grid();
  require(ends.n_end == 0,
          level_text(pool.surface_m) +
              " (the pool reaches the end of the known ground, first at x = " +
              short_number(g.x_center(ends.col)) + ", y = " + short_number(g.y_center(ends.row)) +
              ", and would run out there). Lower it, outline the pool with fluid.pool.polygon or "
              "box, use a larger terrain, or close the end with domain.walls or terrain.nodata: "
              "wall.");
}

}  // namespace

bool Pool::covers(double x, double y) const {
  const int row = share.grid.row_of(y), col = share.grid.col_of(x);
  return share.grid.contains(row, col) && share.at(row, col) > 0.5;
}

std::string pool_key(const PoolSpec& spec) {
  return !spec.polygon.empty() ? "fluid.pool.polygon" : spec.box ? "fluid.pool.box" : "fluid.pool";
}

Window pool_window(const SceneInputs& in) {
  return in.pool ? window_of(in.pool->grid, in.terrain_grid()) : whole_of(in.terrain_grid());
}

double bed_at(const Terrain& bed, const SceneInputs& in, int row, int col) {
  const Window at = window_of(in.terrain_grid(), bed.grid());
  return bed.node(at.row0 + row, at.col0 + col);
}

Pool pool_of(const Scenario& s, const SceneInputs& in, const Terrain& bed) {
  const GroundAt ground = [&](int row, int col) { return bed_at(bed, in, row, col); };
  Pool pool = filled(s, in, ground, s.fluid->pool->surface_m->value);
  // What the ground asks for is read first.
  if (bed.needs_more()) return pool;
  require_water(s, pool, ground, in);
  pool.open_edge_m = ends_of(s, in, pool, ground).open_m;
  return pool;
}

void require_pool(const Scenario& s, const SceneInputs& in) {
  const auto [low, high] = drawn_range(*s.fluid->pool->surface_m);
  const Window held = in.held();
  const GroundAt ground = [&](int row, int col) {
    return held.contains(row, col) ? in.elevation->at(row - held.row0, col - held.col0) : nan_d;
  };
  require_water(s, filled(s, in, ground, low), ground, in);
  require_shore(s, in, filled(s, in, ground, high), ground);
}

}  // namespace sturz
