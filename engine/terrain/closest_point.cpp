// SPDX-License-Identifier: Apache-2.0
// The part of Terrain that measures distance where the tangent plane below is not good enough.
//
//        p .          A tangent plane sees only the ground straight below (b). Where a cliff
//         /|          stands beside the particle, the nearest point is q on the next patch.
//    q __/ |          Every near patch is asked for its closest point and the nearest
//     |    b          wins: continuous across the seams, so that contact makes no energy.
//     |____|____
#include "engine/terrain/terrain.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sturz {

/// The nearest surface point found so far.
struct Terrain::Closest {
  double distance2 = 0;
  Vec3 to_point{0, 0, 1};  ///< from the surface point to the particle
  Vec3 patch_normal{0, 0, 1};
  bool on_seam = false;  ///< on the edge of its patch: the normal is the line to the particle
  double x = 0, y = 0;   ///< of the surface point
};

namespace {

constexpr int newton_steps = 2;
/// Below ground the way out is looked for this many contact distances far, and at most so many
/// cells.
constexpr double deep_distances = 4;
constexpr int most_cells = 8;
/// On a seam closer than this part of the contact distance, the line to the particle has no safe
/// direction.
constexpr double seam_share = 0.02;

/// Gauss-Newton step of half the squared distance over the plane (du, dv), du eastward and dv
/// southward, kept in the box by fixing a coordinate that leaves it and solving for the other.
struct BoxStep {
  double slope_u, slope_v;  ///< of the surface
  double pull_u, pull_v;    ///< minus the gradient of half the squared distance

  double along_v(double du) const {
    return (pull_v - slope_u * slope_v * du) / (1 + slope_v * slope_v);
  }
  double along_u(double dv) const {
    return (pull_u - slope_u * slope_v * dv) / (1 + slope_u * slope_u);
  }
  void apply(double& u, double& v, double size) const {
    const double q = 1 + slope_u * slope_u + slope_v * slope_v;
    double du = ((1 + slope_v * slope_v) * pull_u - slope_u * slope_v * pull_v) / q;
    double dv = ((1 + slope_u * slope_u) * pull_v - slope_u * slope_v * pull_u) / q;
    const double du_in = std::clamp(du, -u, size - u);
    if (du_in != du) du = du_in, dv = along_v(du);
    const double dv_in = std::clamp(dv, -v, size - v);
    if (dv_in != dv) dv = dv_in, du = std::clamp(along_u(dv), -u, size - u);
    u += du;
    v += dv;
  }
};

}  // namespace

SurfaceDistance Terrain::closest(const Vec3& p, const Slope& below, double contact_distance) const {
  const double above = p.z() - below.z;
  const double sign = above < 0 ? -1 : 1;
  Closest best;
  best.to_point = {0, 0, above};
  best.distance2 = above * above;
  best.patch_normal = upward_normal(below.east, below.north);
  best.x = p.x(), best.y = p.y();
  const double radius = above >= 0 ? contact_distance : deep_distances * contact_distance;
  if (contact_distance <= cell_m_)
    search_blocks(p, std::min(radius, most_cells * cell_m_), best);
  else
    search_compass(p, contact_distance, best);
  const double distance = std::sqrt(best.distance2);
  if (best.on_seam && distance > seam_share * contact_distance)
    return {sign * distance, best.to_point * (sign / distance)};
  return {sign * distance, best.patch_normal};
}

/// Asks every patch that overlaps the circle; the circle shrinks as nearer points turn up.
void Terrain::search_blocks(const Vec3& p, double radius, Closest& best) const {
  const double u = (p.x() - west_node_m_) * per_cell_, v = (north_node_m_ - p.y()) * per_cell_;
  const int col = std::min(static_cast<int>(u), grid().n_cols - 2);
  const int row = std::min(static_cast<int>(v), grid().n_rows - 2);
  try_block(row, col, p, best);
  const double r = std::min(radius, std::sqrt(best.distance2)) * per_cell_;
  const int col0 = std::max(0, static_cast<int>(std::floor(u - r)));
  const int col1 = std::min(grid().n_cols - 2, static_cast<int>(std::floor(u + r)));
  const int row0 = std::max(0, static_cast<int>(std::floor(v - r)));
  const int row1 = std::min(grid().n_rows - 2, static_cast<int>(std::floor(v + r)));
  for (int i = row0; i <= row1; ++i)
    for (int j = col0; j <= col1; ++j) {
      if (i == row && j == col) continue;
      const double du = u - std::clamp(u, double(j), j + 1.0);
      const double dv = v - std::clamp(v, double(i), i + 1.0);
      if ((du * du + dv * dv) * cell_m_ * cell_m_ < best.distance2) try_block(i, j, p, best);
    }
}

void Terrain::try_block(int row, int col, const Vec3& p, Closest& best) const {
  if (!holds_block(row, col)) return needs_more_.raise();
  Block b = block_at(row, col);
  const double pu = p.x() - (west_node_m_ + col * cell_m_);
  const double pv = (north_node_m_ - row * cell_m_) - p.y();
  double u = std::clamp(pu, 0.0, cell_m_), v = std::clamp(pv, 0.0, cell_m_);
  for (int k = 0;; ++k) {
    b.east = u * per_cell_;
    b.south = v * per_cell_;
    const Slope s = evaluate(b, per_cell_);
    const Vec3 to_point{pu - u, pv - v, p.z() - s.z};
    const double distance2 = to_point.squaredNorm();
    if (distance2 < best.distance2) {  // false for a patch with missing nodes
      best.distance2 = distance2;
      best.to_point = {to_point.x(), -to_point.y(), to_point.z()};
      best.patch_normal = upward_normal(s.east, s.north);
      best.on_seam = u <= 0 || v <= 0 || u >= cell_m_ || v >= cell_m_;
    }
    if (k == newton_steps || !std::isfinite(s.z)) return;
    BoxStep{s.east, -s.north, to_point.x() + to_point.z() * s.east,
            to_point.y() - to_point.z() * s.north}
        .apply(u, v, cell_m_);
  }
}

/// For ground finer than the contact distance: looks in eight directions, then walks to the closest
/// point across the patches. A patch-by-patch search would cost as much as the rest of the step.
void Terrain::search_compass(const Vec3& p, double contact_distance, Closest& best) const {
  auto look = [&](double x, double y) -> bool {
    Block b;
    if (!find(x, y, b)) return false;
    const Slope s = evaluate(b, per_cell_);
    const Vec3 to_point = p - Vec3(x, y, s.z);
    if (!(to_point.squaredNorm() < best.distance2)) return false;
    best.distance2 = to_point.squaredNorm();
    best.to_point = to_point;
    best.patch_normal = upward_normal(s.east, s.north);
    best.x = x, best.y = y;
    return true;
  };
  constexpr double d = 0.7071067811865476;
  constexpr std::array<std::array<double, 2>, 8> compass{
      {{1, 0}, {d, d}, {0, 1}, {-d, d}, {-1, 0}, {-d, -d}, {0, -1}, {d, -d}}};
  for (const auto& [east, north] : compass)
    look(p.x() + 0.6 * contact_distance * east, p.y() + 0.6 * contact_distance * north);
  for (int k = 0; k < newton_steps; ++k) {
    // The step to the foot on the tangent plane at the best point.
    const Vec3 slide = best.to_point - best.to_point.dot(best.patch_normal) * best.patch_normal;
    if (!look(best.x + slide.x(), best.y + slide.y())) break;
  }
  best.on_seam = true;  // between patches the line to the particle is the smoother direction
}

}  // namespace sturz
