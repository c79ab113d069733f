// SPDX-License-Identifier: Apache-2.0
#include "engine/terrain/terrain.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

/// Nodes around a patch that are copied along, so that every block whose bounds the patch changes
/// lies wholly inside it and one test tells which of the two holds a block.
constexpr int patch_margin = 2;

/// Nearest point of the unit square at (col, row) to (u, v), all in cells.
Vec2 nearest_in_square(int col, int row, double u, double v) {
  return {std::clamp(u, double(col), col + 1.0), std::clamp(v, double(row), row + 1.0)};
}

}  // namespace

Terrain::Terrain(std::shared_ptr<const Raster<double>> elevation, NodataRule rule) : rule_(rule) {
  expect(elevation != nullptr, "a terrain has an elevation raster");
  const Grid& whole = elevation->grid;
  base_ = std::make_shared<const HeldGround>(whole, std::move(elevation));
  set_out();
}

Terrain::Terrain(std::shared_ptr<const HeldGround> ground, NodataRule rule)
    : base_(std::move(ground)), rule_(rule) {
  expect(base_ != nullptr, "a terrain stands on ground");
  set_out();
}

void Terrain::set_out() {
  const Grid& g = base_->grid;
  cell_m_ = g.cell_m;
  per_cell_ = 1 / g.cell_m;
  west_node_m_ = g.x_center(0);
  north_node_m_ = g.y_center(0);
  lowest_m_ = base_->lowest_m;
  n_rows_ = g.n_rows, n_cols_ = g.n_cols;
  stride_ = base_->window.n_cols;
  corner_ = base_->window.row0 * stride_ + base_->window.col0;
  nodes_ = base_->elevation->values.data();
  bounds_ = base_->bounds.data();
  const Window& w = base_->usable;
  first_u_ = w.col0, first_v_ = w.row0;
  last_node_u_ = w.end_col() - 1, last_node_v_ = w.end_row() - 1;
  // Where the raster goes on, the last usable nodes belong to the block behind them.
  last_u_ = w.end_col() == g.n_cols ? last_node_u_ : std::nextafter(last_node_u_, -1);
  last_v_ = w.end_row() == g.n_rows ? last_node_v_ : std::nextafter(last_node_v_, -1);
}

/// A place, in cells from the raster's north-west node, where nothing is held.
void Terrain::note_missing(double u, double v) const {
  if (u >= 0 && v >= 0 && u <= n_cols_ - 1 && v <= n_rows_ - 1) needs_more_.raise();
}

/// How rough the ground is within so many cells; empty where too little of it is held.
std::optional<HeldGround::Tile> Terrain::tiles_around(double u, double v, double cells) const {
  const auto near = [](double at, int n) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, n - 2.0));
  };
  const int row0 = near(v - cells, n_rows_), row1 = near(v + cells, n_rows_);
  const int col0 = near(u - cells, n_cols_), col1 = near(u + cells, n_cols_);
  std::optional<HeldGround::Tile> tile = base_->around(row0, row1, col0, col1);
  if (!tile) {
    needs_more_.raise();
    return tile;
  }
  const int reach = HeldGround::tile;
  if (patch_rows_ > 0 && row1 + reach >= patch_row_ && row0 - reach <= patch_row_ + patch_rows_ &&
      col1 + reach >= patch_col_ && col0 - reach <= patch_col_ + patch_cols_)
    tile->bound = rougher(tile->bound, patch_roughest_);
  return tile;
}

Terrain Terrain::with_patch(int row0, int col0, int n_rows, int n_cols,
                            std::vector<double> new_elevation) const {
  const Grid& g = grid();
  expect(n_rows >= 0 && n_cols >= 0 && row0 >= 0 && col0 >= 0 && row0 + n_rows <= g.n_rows &&
             col0 + n_cols <= g.n_cols,
         "a patch lies on the grid");
  expect(new_elevation.size() == static_cast<std::size_t>(n_rows) * n_cols,
         "a patch has one value per cell");
  Terrain out = *this;
  if (n_rows == 0 || n_cols == 0) return out;
  int top = std::max(0, row0 - patch_margin),
      bottom = std::min(g.n_rows, row0 + n_rows + patch_margin);
  int left = std::max(0, col0 - patch_margin),
      right = std::min(g.n_cols, col0 + n_cols + patch_margin);
  if (patch_rows_ > 0) {
    top = std::min(top, patch_row_), bottom = std::max(bottom, patch_row_ + patch_rows_);
    left = std::min(left, patch_col_), right = std::max(right, patch_col_ + patch_cols_);
  }
  out.patch_row_ = top, out.patch_rows_ = bottom - top;
  out.patch_col_ = left, out.patch_cols_ = right - left;
  out.patch_.resize(static_cast<std::size_t>(out.patch_rows_) * out.patch_cols_);
  auto at = [&](int row, int col) {
    return static_cast<std::size_t>(row - top) * out.patch_cols_ + (col - left);
  };
  for (int r = top; r < bottom; ++r)
    for (int c = left; c < right; ++c) out.patch_[at(r, c)] = node(r, c);
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c) {
      const double z = new_elevation[static_cast<std::size_t>(r) * n_cols + c];
      if (std::isnan(z)) continue;
      out.patch_[at(row0 + r, col0 + c)] = z;
      out.lowest_m_ = std::min(out.lowest_m_, z);
    }
  out.patch_bounds_ = surface_bounds(out.patch_, out.patch_rows_, out.patch_cols_, cell_m_);
  // The patch's outer blocks see nodes beyond it: the base's bounds cover those.
  for (int r = top; r < bottom; ++r)
    for (int c = left; c < right; ++c) {
      SurfaceBound& b = out.patch_bounds_[at(r, c)];
      if (holds(r, c)) b = rougher(b, bounds_[r * stride_ + c - corner_]);
      out.patch_roughest_ = rougher(out.patch_roughest_, b);
    }
  if (needs_more()) out.needs_more_.raise();  // reading the nodes may have told
  return out;
}

double Terrain::node(int row, int col) const {
  const int r = row - patch_row_, c = col - patch_col_;
  if (r >= 0 && r < patch_rows_ && c >= 0 && c < patch_cols_)
    return patch_[static_cast<std::size_t>(r) * patch_cols_ + c];
  if (holds(row, col)) return nodes_[row * stride_ + col - corner_];
  needs_more_.raise();
  return nan_d;
}

bool Terrain::block_inside(int row, int col) const {
  return std::isfinite(node(row, col) + node(row, col + 1) + node(row + 1, col) +
                       node(row + 1, col + 1));
}

bool Terrain::inside(double x, double y) const {
  Block b;
  return find(x, y, b) && std::isfinite(evaluate(b, per_cell_).z);
}

double Terrain::height(double x, double y) const {
  Block b;
  if (find(x, y, b)) {
    const double z = evaluate(b, per_cell_).z;
    if (std::isfinite(z)) return z;
  }
  return surface_outside(x, y).z;
}

SurfacePoint Terrain::surface(double x, double y) const {
  Block b;
  if (find(x, y, b)) {
    const Slope s = evaluate(b, per_cell_);
    if (std::isfinite(s.z)) return {s.z, upward_normal(s.east, s.north)};
  }
  return surface_outside(x, y);
}

bool Terrain::distance_inside(const Vec3& p, double contact_distance, SurfaceDistance& out) const {
  Block b;
  if (!find(p.x(), p.y(), b)) return false;
  const Slope s = evaluate(b, per_cell_);
  if (!std::isfinite(s.z)) return false;
  const double above = p.z() - s.z;
  SurfaceBound bound = *b.bound;
  if (contact_distance > cell_m_) {  // a block's bounds hold within one cell
    const double u = (p.x() - west_node_m_) * per_cell_, v = (north_node_m_ - p.y()) * per_cell_;
    const auto around = tiles_around(u, v, contact_distance * per_cell_);
    if (!around) return false;
    bound = around->bound;
  }
  if (bound.curvature_per_m * contact_distance <= 0.2 ||
      above * bound.min_normal_z > contact_distance) {
    const Vec3 normal = upward_normal(s.east, s.north);
    out = {above * normal.z(), normal};
  } else {
    out = closest(p, s, contact_distance);
  }
  return true;
}

SurfaceDistance Terrain::distance(const Vec3& p, double contact_distance) const {
  SurfaceDistance found;
  if (distance_inside(p, contact_distance, found)) return found;
  const SurfacePoint level = surface_outside(p.x(), p.y());
  return {p.z() - level.z, level.normal};
}

double Terrain::clearance(const Vec3& p) const {
  Block b;
  if (!find(p.x(), p.y(), b)) return 0;
  constexpr double reach = HeldGround::tile;  // in cells
  const double u = (p.x() - west_node_m_) * per_cell_, v = (north_node_m_ - p.y()) * per_cell_;
  const auto around = tiles_around(u, v, reach);
  if (!around || !around->known) return 0;
  const double above = (p.z() - evaluate(b, per_cell_).z) * around->bound.min_normal_z;
  const double boundary = std::min({u, v, n_cols_ - 1 - u, n_rows_ - 1 - v, reach}) * cell_m_;
  return std::max(0.0, std::min(above, boundary));
}

SurfacePoint Terrain::surface_outside(double x, double y) const {
  if (!std::isfinite(x) || !std::isfinite(y)) return {nan_d, {0, 0, 1}};
  const std::optional<Vec2> edge = nearest_inside(x, y);
  if (!edge) return {lowest_m_, {0, 0, 1}};
  const int col = std::min(static_cast<int>(edge->x()), grid().n_cols - 2);
  const int row = std::min(static_cast<int>(edge->y()), grid().n_rows - 2);
  // The nearest point may lie on the seam to an unknown block: take it from a known one.
  for (int r : {row, std::max(0, row - 1)})
    for (int c : {col, std::max(0, col - 1)}) {
      if (!holds_block(r, c)) {
        needs_more_.raise();
        continue;
      }
      Block b = block_at(r, c);
      b.east = edge->x() - c;
      b.south = edge->y() - r;
      const double z = evaluate(b, per_cell_).z;
      if (b.east <= 1 && b.south <= 1 && std::isfinite(z)) return {z, {0, 0, 1}};
    }
  return {lowest_m_, {0, 0, 1}};
}

/// The nearest point of known ground in cells from the north-west node, by growing rings.
std::optional<Vec2> Terrain::nearest_inside(double x, double y) const {
  const int last_col = grid().n_cols - 2, last_row = grid().n_rows - 2;
  const double u = std::clamp((x - west_node_m_) * per_cell_, 0.0, last_col + 1.0);
  const double v = std::clamp((north_node_m_ - y) * per_cell_, 0.0, last_row + 1.0);
  const int col = std::min(static_cast<int>(u), last_col);
  const int row = std::min(static_cast<int>(v), last_row);
  std::optional<Vec2> best;
  double best2 = std::numeric_limits<double>::infinity();
  auto look = [&](int r, int c) {
    if (r < 0 || c < 0 || r > last_row || c > last_col || !block_inside(r, c)) return;
    const Vec2 q = nearest_in_square(c, r, u, v);
    const double d2 = (q - Vec2(u, v)).squaredNorm();
    if (d2 < best2) best2 = d2, best = q;
  };
  for (int ring = 0; ring <= search_cells; ++ring) {
    // Everything in this ring is at least ring - 1 cells away.
    if (best && best2 <= (ring - 1.0) * (ring - 1.0)) break;
    for (int c = col - ring; c <= col + ring; ++c) {
      look(row - ring, c);
      if (ring > 0) look(row + ring, c);
    }
    for (int r = row - ring + 1; r < row + ring; ++r) {
      look(r, col - ring);
      look(r, col + ring);
    }
  }
  return best;
}

}  // namespace sturz
