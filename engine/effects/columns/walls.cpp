// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/columns/walls.hpp"

#include "engine/neighbors/column_smoothing.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

double distance(const Wall& wall, const Vec3& position) {
  return (position - wall.point).dot(wall.normal);
}

/// The wall's normal as far as the ground lets a column move along it; not unit.
Vec3 along_ground(const Wall& wall, const Vec3& ground_normal) {
  return wall.normal - wall.normal.dot(ground_normal) * ground_normal;
}

}  // namespace

HalfSupport::HalfSupport() {
  constexpr int n_points = 400;
  const ColumnSmoothing unit{1};
  for (int k = 0; k <= n; ++k) {
    const double d = static_cast<double>(k) / n;
    const double end = std::sqrt(std::max(0.0, 1 - d * d)), step = end / n_points;
    for (int i = 0; i < n_points; ++i)
      line_[k] += 2 * step * unit.value(std::hypot(d, (i + 0.5) * step));
  }
  for (int k = n - 1; k >= 0; --k)
    beyond_[k] = beyond_[k + 1] + 0.5 * (line_[k] + line_[k + 1]) / n;
}

double HalfSupport::between(const std::array<double, n + 1>& table, double d) {
  if (!(d < 1)) return 0;
  const double at = std::max(0.0, d) * n;
  const int k = std::min(n - 1, static_cast<int>(at));
  return table[k] + (at - k) * (table[k + 1] - table[k]);
}

double ColumnWalls::thickness_factor(const Domain& domain, double time, const Vec3& position,
                                     double support_radius) const {
  return 1 / share_in_front(domain, time, position, support_radius, nullptr);
}

double ColumnWalls::share_in_front(const Domain& domain, double time, const Vec3& position,
                                   double support_radius, const Wall* but) const {
  double share = 1;
  for (const Wall& wall : domain.walls)
    if (&wall != but && time < wall.remove_at_s)
      share *= 1 - support_.beyond(distance(wall, position) / support_radius);
  return share;
}

Vec3 ColumnWalls::pressure(const Domain& domain, double time, const Wall& wall,
                           const ColumnAtWall& c) const {
  const double line = support_.line(distance(wall, c.position) / c.support_radius) /
                      c.support_radius *
                      share_in_front(domain, time, c.position, c.support_radius, &wall);
  return c.lateral * c.thickness * line * wall.normal;
}

ColumnWalls::Impulse ColumnWalls::impulse(const Wall& wall, const ColumnAtWall& c,
                                          const Vec3& velocity, double pressed,
                                          double drift) const {
  Impulse out;
  const Vec3 direction = along_ground(wall, c.ground_normal);
  const double free = direction.squaredNorm();
  const double d = distance(wall, c.position), speed = velocity.dot(wall.normal);
  const double stop = std::max(0.0, -d / drift - speed);
  if (free < 1e-12 || (stop == 0 && pressed == 0)) return out;
  out.normal = stop / free * direction;
  const Vec3 after = velocity + out.normal;
  const Vec3 sliding = after - after.dot(direction) / free * direction;
  const double slip = sliding.norm();
  const double most = wall.friction_coefficient * (stop / std::sqrt(free) + pressed);
  if (slip > 0) out.friction = -std::min(1.0, most / slip) * sliding;
  return out;
}

}  // namespace sturz
