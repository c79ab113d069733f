// SPDX-License-Identifier: Apache-2.0
/// Sums at a gauge, and what follows from a gauge's series at the end of a run.
#pragma once

#include "engine/effects/fields.hpp"
#include "engine/effects/moving_set.hpp"
#include "engine/simulation/gauges/gauge_result.hpp"

#include <cmath>
#include <vector>

namespace sturz {

/// Over the particles around a point, per map area.
struct GaugeSums {
  double volume = 0, mass = 0;  ///< [m], [kg/m^2]
  Vec3 momentum{0, 0, 0};       ///< [kg/(m s)]

  void add(double weight, double particle_volume, double particle_mass, const Vec3& v) {
    volume += weight * particle_volume;
    mass += weight * particle_mass;
    momentum += weight * particle_mass * v;
  }
  double speed() const { return mass > 0 ? momentum.norm() / mass : 0; }
  /// rho h v^2 [N/m].
  double momentum_flux() const { return mass > 0 ? momentum.squaredNorm() / mass : 0; }
};

/// How wide the particles of a set are spread, as on the maps (PeakMaps).
class SpreadWidth {
 public:
  explicit SpreadWidth(const MovingSet& p) : spacing_(p.spacing) {
    if (const Field* radius = p.find(fields::support_radius)) radius_ = radius->component[0].data();
  }
  /// Of particle i at a place this far from it [1/m^2].
  double weight(std::size_t i, const Vec2& away) const {
    const double width = radius_ ? per_radius * radius_[i] : spacing_;
    const double x = std::abs(away.x()) / width, y = std::abs(away.y()) / width;
    if (!(x < 1.5 && y < 1.5)) return 0;
    return b_spline(x) * b_spline(y) / (width * width);
  }

 private:
  static constexpr double per_radius = 0.375;
  static double b_spline(double t) { return t < 0.5 ? 0.75 - t * t : 0.5 * (1.5 - t) * (1.5 - t); }

  double spacing_;
  const double* radius_ = nullptr;
};

/// Arrival between the instants before and after the thickness passed `reached_m`, and peaks.
void close_point(const std::vector<double>& time_s, double reached_m, PointSeries&);
/// Discharges, peak and direction, from the volumes.
void close_line(const std::vector<double>& time_s, LineSeries&);

}  // namespace sturz
