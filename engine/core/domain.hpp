// SPDX-License-Identifier: Apache-2.0
/// What bounds a scene besides the ground: analytic walls and periodic directions.
#pragma once

#include "engine/core/vec.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace sturz {

/// A plane that holds the particles on the side of its normal.
struct Wall {
  Vec3 point{0, 0, 0};
  Vec3 normal{0, 0, 1};  ///< unit, into the free side
  double friction_coefficient = 0;
  double remove_at_s = std::numeric_limits<double>::infinity();
};

/// One periodic direction: leaving at `max` means entering at `min`, `rise` lower or higher.
struct Period {
  bool active = false;
  double min = 0, max = 0;  ///< [m]
  double rise = 0;          ///< z(max) - z(min) of the repeating terrain [m]
  double length() const { return max - min; }
};

struct Domain {
  std::vector<Wall> walls;
  Period x, y;

  /// Brings a point into the periodic box.
  template <class T>
  void wrap(T& px, T& py, T& pz) const {
    wrap_one(x, px, pz);
    wrap_one(y, py, pz);
  }

 private:
  /// By division, not by turns: a particle that ran away must not hang its member.
  template <class T>
  static void wrap_one(const Period& p, T& position, T& z) {
    if (!p.active || (position >= p.min && position < p.max)) return;
    const T turns = std::floor((position - p.min) / p.length());
    position -= turns * p.length();
    z -= turns * p.rise;
  }
};

}  // namespace sturz
