// SPDX-License-Identifier: Apache-2.0
/// The ground: a C0 bilinear heightfield through the cell centres of an elevation raster.
///
/// The base raster is shared, read-only, by all members; a member may lay a small patch over it
/// (the excavation of a pre-failure surface). Never a staircase: steps in the surface change the
/// apparent friction (Iverson & George 2019).
///
/// Of a large raster only a window may be held. A question for ground beyond it, where the raster
/// goes on, gets an answer as beyond the raster's edge, and needs_more() is true from then on:
/// nothing that was computed on this terrain holds, and it is to be computed again with a larger
/// window. As long as needs_more() is false every answer has the bits that the whole raster gives.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/held_ground.hpp"
#include "engine/terrain/raster.hpp"
#include "engine/terrain/surface_bounds.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sturz {

/// What the edge of the known ground does to a particle.
enum class NodataRule { outflow, wall };

/// Height and upward unit normal of the surface above a map point.
struct SurfacePoint {
  double z = 0;          ///< surface elevation [m]
  Vec3 normal{0, 0, 1};  ///< outward (upward) unit normal [-]
};

/// The ground rounded over about two cells: one smooth surface with its first and second
/// derivatives, for what slides on it as a depth-averaged column.
struct CurvedSurface {
  double z = 0;                                                 ///< [m]
  double east = 0, north = 0;                                   ///< slope [-]
  double curvature_ee = 0, curvature_en = 0, curvature_nn = 0;  ///< second derivatives [1/m]
  bool known = true;  ///< false off the known ground (level there)

  /// d2z/ds2 times speed squared, for a horizontal velocity [m/s^2].
  double curvature(double vx, double vy) const {
    return curvature_ee * vx * vx + 2 * curvature_en * vx * vy + curvature_nn * vy * vy;
  }
};

/// Upward unit normal of a surface with these slopes.
inline Vec3 upward_normal(double slope_east, double slope_north) {
  const double n_z = 1 / std::sqrt(1 + slope_east * slope_east + slope_north * slope_north);
  return {-slope_east * n_z, -slope_north * n_z, n_z};
}

/// Signed distance along the normal of the nearest surface point, positive above the ground.
struct SurfaceDistance {
  double distance = 0;   ///< [m]
  Vec3 normal{0, 0, 1};  ///< at the nearest point [-]
};

/// A new elevation of a cell centre.
struct NodeChange {
  int row = 0, col = 0;
  double z = 0;  ///< [m]
};

/// A flag that many threads may raise and none lowers; a copy starts as its original stands.
class RaisedFlag {
 public:
  RaisedFlag() = default;
  ~RaisedFlag() = default;
  RaisedFlag(const RaisedFlag& o) : up_(o.up()) {}
  RaisedFlag& operator=(const RaisedFlag& o) {
    up_.store(o.up(), std::memory_order_relaxed);
    return *this;
  }
  void raise() { up_.store(true, std::memory_order_relaxed); }
  bool up() const { return up_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> up_{false};
};

class Terrain {
 public:
  /// \param elevation metres above datum, NaN = nodata. At least 2 x 2 cells.
  /// \throws SetupError if the raster is too small or holds no valid 2 x 2 block
  Terrain(std::shared_ptr<const Raster<double>> elevation, NodataRule rule);
  /// The same where only a part of the raster is held.
  Terrain(std::shared_ptr<const HeldGround> ground, NodataRule rule);

  /// The same ground with `new_elevation` laid over the window that starts at (row0, col0);
  /// the patch holds n_rows x n_cols elevations [m], NaN keeps the value below it. Patches add up.
  /// \pre the window lies on the grid
  Terrain with_patch(int row0, int col0, int n_rows, int n_cols,
                     std::vector<double> new_elevation) const;

  /// Changes nodes of this terrain alone: erosion and deposition under one member. The base stays
  /// shared. Work follows the changed nodes; the member's patch grows now and then, with room to
  /// spare, and is never copied for a step.
  /// \pre nodes lie on the grid, elevations are finite
  void change(std::span<const NodeChange>);
  /// Goes up with every change.
  std::size_t n_changes() const { return n_changes_; }
  /// Memory of what only this member has [bytes].
  std::size_t patch_bytes() const {
    return patch_.capacity() * sizeof(double) + patch_bounds_.capacity() * sizeof(SurfaceBound);
  }

  /// Of the whole raster, whatever part of it is held.
  const Grid& grid() const { return base_->grid; }
  const Window& held() const { return base_->window; }
  /// True once ground was asked for that the raster has and this terrain does not hold.
  bool needs_more() const { return needs_more_.up(); }
  NodataRule nodata_rule() const { return rule_; }
  /// Elevation of a cell centre with the patch applied [m]; NaN = nodata. In-range indices only.
  double node(int row, int col) const;

  /// True where the four cell centres around (x, y) are known: there the surface exists.
  bool inside(double x, double y) const;
  /// Surface height [m]. Outside, the nearest inside edge is continued level; it is looked for
  /// within `search_cells` cells of the grid's nearest point, beyond that the ground lies at the
  /// lowest known elevation. NaN only for a NaN point.
  double height(double x, double y) const;
  /// Height and normal of the bilinear patch; level outside, like height().
  SurfacePoint surface(double x, double y) const;
  /// The biquadratic B-spline with the nodes as control points: exact on planes, C1 everywhere, so
  /// that energy is kept along it and curvature is bounded by that of neighbouring nodes. Beside
  /// unknown cells the bilinear surface stands in, without curvature.
  CurvedSurface curved(double x, double y) const;
  /// Distance of `p` to the surface, negative below it: (z - z_s) n_z where the ground within
  /// `contact_distance` is smooth. Where its slope exceeds 45 degrees or its curvature times
  /// `contact_distance` 0.2, a point that may touch gets the distance to the closest point (two
  /// Newton steps on every patch within the contact distance), so that a cliff beside a particle
  /// counts. The sign is always that of z - z_s. \param contact_distance  [m]; farther up the
  /// tangent plane's distance is returned.
  ///               Up to one cell costs 20-40 ns; more looks at tiles of 16 x 16 cells and costs
  ///               several times as much where one of them is bent
  SurfaceDistance distance(const Vec3& p, double contact_distance) const;
  /// The same where the ground is known; false off it, and `out` untouched.
  bool distance_inside(const Vec3& p, double contact_distance, SurfaceDistance& out) const;
  /// No point of the ground and no boundary of the known ground is nearer than this [m]: the height
  /// above ground times the least n_z in the tiles (16 x 16 cells) around, never more than to their
  /// edge. 0 where some of them is unknown, or off the raster.
  double clearance(const Vec3& p) const;

  static constexpr int search_cells = 64;

 private:
  /// Four nodes around a point, its place between them (0..1 eastward, 0..1 southward).
  struct Block {
    const double* north_west;  ///< node; its eastern neighbour follows
    std::ptrdiff_t stride;     ///< to the node south of it
    const SurfaceBound* bound;
    double east, south;
  };
  struct Slope {
    double z;            ///< [m]; not finite where a node is missing
    double east, north;  ///< rise per metre [-]
  };
  struct Closest;

  void set_out();
  bool holds(int row, int col) const;
  bool holds_block(int row, int col) const;
  void note_missing(double u, double v) const;
  std::optional<HeldGround::Tile> tiles_around(double u, double v, double cells) const;
  void cover(int row0, int col0, int row1, int col1);
  void refresh_bounds(int row0, int col0, int row1, int col1);
  bool find(double x, double y, Block& block) const;
  Block block_at(int row, int col) const;
  bool block_inside(int row, int col) const;
  static Slope evaluate(const Block& block, double per_cell);
  std::optional<Vec2> nearest_inside(double x, double y) const;
  SurfacePoint surface_outside(double x, double y) const;
  SurfaceDistance closest(const Vec3& p, const Slope& below, double contact_distance) const;
  void try_block(int row, int col, const Vec3& p, Closest& best) const;
  void search_blocks(const Vec3& p, double radius, Closest& best) const;
  void search_compass(const Vec3& p, double contact_distance, Closest& best) const;

  std::shared_ptr<const HeldGround> base_;
  NodataRule rule_;
  // Of the base, at hand.
  const double* nodes_ = nullptr;             ///< [held]
  const SurfaceBound* bounds_ = nullptr;      ///< [held]
  std::ptrdiff_t stride_ = 0;                 ///< from a node to the one south of it
  std::ptrdiff_t corner_ = 0;                 ///< index of the first held node, by this stride
  int n_rows_ = 0, n_cols_ = 0;               ///< of the whole raster
  double first_u_ = 0, first_v_ = 0;          ///< first usable column and row of nodes
  double last_u_ = 0, last_v_ = 0;            ///< last place between usable nodes
  double last_node_u_ = 0, last_node_v_ = 0;  ///< last usable column and row of nodes
  double west_node_m_ = 0, north_node_m_ = 0, cell_m_ = 1, per_cell_ = 1;
  double lowest_m_ = 0;
  int patch_row_ = 0, patch_col_ = 0, patch_rows_ = 0,
      patch_cols_ = 0;  ///< with a margin of nodes of the base raster
  std::vector<double> patch_;
  std::vector<SurfaceBound> patch_bounds_;
  SurfaceBound patch_roughest_;  ///< over the patch
  std::size_t n_changes_ = 0;
  mutable RaisedFlag needs_more_;
};

inline Terrain::Block Terrain::block_at(int row, int col) const {
  const int r = row - patch_row_, c = col - patch_col_;
  if (r >= 0 && r < patch_rows_ - 1 && c >= 0 && c < patch_cols_ - 1) {
    const std::size_t i = static_cast<std::size_t>(r) * patch_cols_ + c;
    return {&patch_[i], patch_cols_, &patch_bounds_[i], 0, 0};
  }
  const std::ptrdiff_t i = row * stride_ + col - corner_;
  return {nodes_ + i, stride_, bounds_ + i, 0, 0};
}

inline bool Terrain::holds(int row, int col) const { return base_->usable.contains(row, col); }
inline bool Terrain::holds_block(int row, int col) const {
  return holds(row, col) && holds(row + 1, col + 1);
}

/// The block below a point; false beyond the outermost nodes and for a NaN point.
inline bool Terrain::find(double x, double y, Block& block) const {
  const double u = (x - west_node_m_) * per_cell_, v = (north_node_m_ - y) * per_cell_;
  if (!(u >= first_u_ && v >= first_v_ && u <= last_u_ && v <= last_v_)) {
    note_missing(u, v);
    return false;
  }
  // A point on the raster's last node row or column belongs to the block before it.
  const int col = std::min(static_cast<int>(u), n_cols_ - 2);
  const int row = std::min(static_cast<int>(v), n_rows_ - 2);
  block = block_at(row, col);
  block.east = u - col;
  block.south = v - row;
  return true;
}

/// Bilinear interpolation between the four nodes.
inline Terrain::Slope Terrain::evaluate(const Block& b, double per_cell) {
  const double* n = b.north_west;
  const double* s = n + b.stride;
  const double rise_n = n[1] - n[0], rise_s = s[1] - s[0];
  const double z_n = n[0] + b.east * rise_n, z_s = s[0] + b.east * rise_s;
  return {z_n + b.south * (z_s - z_n), (rise_n + b.south * (rise_s - rise_n)) * per_cell,
          (z_n - z_s) * per_cell};
}

}  // namespace sturz
