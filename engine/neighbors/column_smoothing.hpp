// SPDX-License-Identifier: Apache-2.0
/// The Wendland C2 smoothing kernel in two dimensions, by its support radius R.
#pragma once

#include <algorithm>
#include <numbers>

namespace sturz {

struct ColumnSmoothing {
  double support_radius = 2;  ///< R [m]

  /// W(r) = 7/(pi R^2) t^4 (4 q + 1) with q = r/R, t = max(0, 1 - q) [1/m^2]
  double value(double r) const {
    const double q = r / support_radius, t = std::max(0.0, 1 - q), t2 = t * t;
    return 7 / (std::numbers::pi * support_radius * support_radius) * t2 * t2 * (4 * q + 1);
  }
  /// C(r) in grad_i W_ij = -C r_ij [1/m^4]
  double gradient(double r) const {
    const double t = std::max(0.0, 1 - r / support_radius), r2 = support_radius * support_radius;
    return 140 / (std::numbers::pi * r2 * r2) * t * t * t;
  }
};

}  // namespace sturz
