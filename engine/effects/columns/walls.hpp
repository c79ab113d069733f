// SPDX-License-Identifier: Apache-2.0
/// What a domain's plane walls do to depth-averaged columns beside them.
///
/// The half of a column's support that lies behind a wall is taken as filled to the column's own
/// thickness: the thickness grows by one over the share in front, and the missing half's pressure
/// K g_n h W_line(d) acts along the wall's normal, which leaves a level surface beside a wall at
/// rest. No column passes the wall; both impulses count for the wall's friction.
#pragma once

#include "engine/core/domain.hpp"

#include <array>

namespace sturz {

/// Integrals of the smoothing function with support radius 1 over a line and over what lies beyond
/// it.
class HalfSupport {
 public:
  HalfSupport();
  /// Integral of W along a line at distance d of the centre, times R [-]; d in support radii, >= 0.
  double line(double d) const { return between(line_, d); }
  /// Share of W beyond that line [-].
  double beyond(double d) const { return between(beyond_, d); }

 private:
  static constexpr int n = 256;
  static double between(const std::array<double, n + 1>& table, double d);
  std::array<double, n + 1> line_{}, beyond_{};
};

/// A column as a wall meets it.
struct ColumnAtWall {
  Vec3 position, ground_normal;
  double support_radius = 1, thickness = 1, lateral = 0;  ///< [m], [m], K g_n [m/s^2]
};

class ColumnWalls {
 public:
  /// Factor on the summed thickness of a column at `position`.
  double thickness_factor(const Domain&, double time, const Vec3& position,
                          double support_radius) const;
  /// Acceleration by what one wall mirrors, in a corner only the part in front of the others
  /// [m/s^2].
  Vec3 pressure(const Domain&, double time, const Wall&, const ColumnAtWall&) const;
  /// Change of velocity that keeps the column from crossing within `drift` seconds, and friction
  /// against that change and what the wall's pressure has `pressed` [m/s].
  struct Impulse {
    Vec3 normal{0, 0, 0}, friction{0, 0, 0};  ///< [m/s]
  };
  Impulse impulse(const Wall&, const ColumnAtWall&, const Vec3& velocity, double pressed,
                  double drift) const;

 private:
  /// Share of a column's support before all walls that stand, but one.
  double share_in_front(const Domain&, double time, const Vec3& position, double support_radius,
                        const Wall* but) const;

  HalfSupport support_;
};

}  // namespace sturz
