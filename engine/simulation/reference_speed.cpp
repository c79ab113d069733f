// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/reference_speed.hpp"

#include "engine/core/constants.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr double gravity = standard_gravity;
constexpr std::size_t most_starts = 48, few_starts = 6;

/// The ground as a mass point feels it: averaged over one cell, so that slope and curvature are
/// smooth although the bilinear patches have kinks. All derivatives belong to nearly one surface,
/// which keeps the energy of a frictionless point.
struct Ground {
  double z, zx, zy, zxx, zxy, zyy;
};

Ground ground_at(const Terrain& terrain, double x, double y) {
  const double c = terrain.grid().cell_m;
  double h[3][3];
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) h[j][i] = terrain.height(x + (i - 1) * c, y + (j - 1) * c);
  // Averages by weights 1 2 1, across the direction of the derivative.
  auto row = [&](int j) { return 0.25 * (h[j][0] + 2 * h[j][1] + h[j][2]); };
  auto column = [&](int i) { return 0.25 * (h[0][i] + 2 * h[1][i] + h[2][i]); };
  Ground g;
  g.z = 0.25 * (row(0) + 2 * row(1) + row(2));
  g.zx = (column(2) - column(0)) / (2 * c);
  g.zy = (row(2) - row(0)) / (2 * c);
  g.zxx = (column(2) - 2 * column(1) + column(0)) / (c * c);
  g.zyy = (row(2) - 2 * row(1) + row(0)) / (c * c);
  g.zxy = (h[2][2] - h[2][0] - h[0][2] + h[0][0]) / (4 * c * c);
  return g;
}

/// One mass point: drift half, kick with gravity, reaction and friction, drift half.
///
/// With z = f(x, y), N = (g + v . hess f . v) / q and q = 1 + |grad f|^2, the reaction is
/// N sqrt(q) and the horizontal acceleration -N grad f - mu N sqrt(q) v / |v|.
class MassPoint {
 public:
  MassPoint(const Terrain& terrain, double friction, double x, double y, double speed)
      : terrain_(terrain), friction_(friction), x_(x), y_(y) {
    const Ground g = ground_at(terrain, x, y);
    const double slope = std::hypot(g.zx, g.zy);
    if (slope > 0) {
      // `speed` is along the surface; its horizontal part points down the slope.
      const double horizontal = speed / std::sqrt(1 + slope * slope);
      vx_ = -horizontal * g.zx / slope;
      vy_ = -horizontal * g.zy / slope;
    }
    energy_ = 0.5 * speed * speed + gravity * g.z;
    speed_ = speed;
  }

  /// Largest speed until rest, domain boundary or end.
  double fastest(double end_time) {
    const double cell = terrain_.grid().cell_m;
    const Grid& grid = terrain_.grid();
    // Longer than any path that ends; bounds the cost of a frictionless bowl.
    const int most_steps = 2000 + 8 * (grid.n_cols + grid.n_rows);
    double fastest = speed_;
    double& t = elapsed_;
    for (int n = 0; n < most_steps && t < end_time; ++n) {
      // A quarter of a cell at this speed and at the speed that free fall gives in this step.
      const double fall = std::sqrt(speed_ * speed_ + 0.5 * gravity * cell);
      const double dt = std::min(0.25 * cell / fall, end_time - t);
      if (!step(dt)) break;
      fastest = std::max(fastest, speed_);
      t += dt;
    }
    return fastest;
  }
  /// Of the way that `fastest` followed [s].
  double elapsed() const { return elapsed_; }

 private:
  /// False at rest and beyond the known ground.
  bool step(double dt) {
    x_ += 0.5 * dt * vx_;
    y_ += 0.5 * dt * vy_;
    if (!terrain_.inside(x_, y_)) return false;
    const Ground g = ground_at(terrain_, x_, y_);
    const double q = 1 + g.zx * g.zx + g.zy * g.zy;
    const double curvature = g.zxx * vx_ * vx_ + 2 * g.zxy * vx_ * vy_ + g.zyy * vy_ * vy_;
    const double reaction = std::max(0.0, (gravity + curvature) / q);
    vx_ -= dt * reaction * g.zx;
    vy_ -= dt * reaction * g.zy;
    const double before = along_surface(g);
    const double braked = friction_ * reaction * std::sqrt(q) * dt;
    const bool stopped = before <= braked;
    scale(stopped ? 0 : 1 - braked / before);
    const double after = stopped ? 0 : before - braked;
    energy_ -= (before - after) * 0.5 * (speed_ + after);
    // The new velocity belongs to the end of the step.
    limit_to_energy(after, g.z + 0.5 * dt * (g.zx * vx_ + g.zy * vy_));
    x_ += 0.5 * dt * vx_;
    y_ += 0.5 * dt * vy_;
    const bool holds = friction_ * friction_ >= q - 1;
    return std::isfinite(speed_) && !(stopped && holds);
  }
  double along_surface(const Ground& g) const {
    const double vz = g.zx * vx_ + g.zy * vy_;
    return std::sqrt(vx_ * vx_ + vy_ * vy_ + vz * vz);
  }
  void scale(double factor) {
    vx_ *= factor;
    vy_ *= factor;
  }
  /// A point kept on a falling cliff would gain speed from geometry alone: what gravity gave less
  /// what friction took is the most it can have.
  void limit_to_energy(double speed, double z) {
    speed_ = speed;
    const double slack = 1e-3 * gravity * terrain_.grid().cell_m;
    const double most2 = 2 * std::max(0.0, energy_ - gravity * z + slack);
    if (speed_ * speed_ <= most2) return;
    scale(std::sqrt(most2) / speed_);
    speed_ = std::sqrt(most2);
  }

  const Terrain& terrain_;
  double friction_;
  double x_, y_, vx_ = 0, vy_ = 0;
  double speed_ = 0;
  double elapsed_ = 0;
  double energy_ = 0;  ///< per mass, kinetic and potential, less the work of friction
};

}  // namespace

double reference_speed(const Terrain& terrain, const Release& release, double effective_friction,
                       double initial_speed, double end_time_s) {
  const double speed = std::max(0.0, initial_speed);
  double fastest = std::max(speed, std::sqrt(gravity * std::max(0.0, release.max_thickness_m)));
  const double friction = std::max(0.0, effective_friction);
  auto run = [&](std::size_t i) {
    if (!terrain.inside(release.x[i], release.y[i])) return;
    MassPoint point(terrain, friction, release.x[i], release.y[i], speed);
    fastest = std::max(fastest, point.fastest(end_time_s));
  };
  const std::size_t n = release.x.size();
  if (n == 0) return fastest;
  const std::size_t stride = (n + most_starts - 1) / most_starts;
  for (std::size_t i = stride / 2; i < n; i += stride) run(i);
  // The highest start has the most to fall; a stride may miss it.
  run(static_cast<std::size_t>(std::max_element(release.z.begin(), release.z.end()) -
                               release.z.begin()));
  return fastest;
}

double time_to_rest(const Terrain& terrain, const Release& release, double effective_friction,
                    double initial_speed, double end_time_s) {
  const std::size_t n = release.x.size();
  const std::size_t stride = std::max<std::size_t>(1, (n + few_starts - 1) / few_starts);
  double longest = 0;
  for (std::size_t i = stride / 2; i < n; i += stride) {
    if (!terrain.inside(release.x[i], release.y[i])) continue;
    MassPoint point(terrain, std::max(0.0, effective_friction), release.x[i], release.y[i],
                    std::max(0.0, initial_speed));
    point.fastest(end_time_s);
    longest = std::max(longest, point.elapsed());
  }
  return longest;
}

}  // namespace sturz
