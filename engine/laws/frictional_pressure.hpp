// SPDX-License-Identifier: Apache-2.0
/// Pressure of enduring contacts between the loosest packing that carries load and the densest.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {

/// p = Fr (alpha - alpha_min)_+^2 / max(alpha_max - alpha, 0.02)^5, Gao et al. Eq. (23) after
/// Johnson & Jackson; docs/physics.md A.7. Never falls with alpha. The fifth power makes it stiffer
/// than anything a time step can follow, hence `limit_slope`.
struct FrictionalPressure {
  static constexpr double smallest_gap = 0.02;  ///< floor of alpha_max - alpha [-]

  double scale_pa = 0.05;      ///< Fr [Pa]
  double min_fraction = 0.5;   ///< alpha_min [-]
  double max_fraction = 0.64;  ///< alpha_max [-]

  /// Largest dp/dalpha allowed [Pa]. Set it by `limit_slope`, after the three numbers above.
  double steepest = std::numeric_limits<double>::infinity();
  double crossover = std::numeric_limits<double>::infinity();  ///< fraction where it is reached
  double crossover_pressure_pa = 0;                            ///< p there [Pa]

  /// Beyond the fraction where the slope would exceed `steepest_pa` the pressure goes on linearly
  /// with that slope. \param steepest_pa  > 0 [Pa]
  void limit_slope(double steepest_pa) {
    steepest = crossover = std::numeric_limits<double>::infinity();
    const double edge = max_fraction - smallest_gap;  // from here on the gap is the floor
    const double stiff = 2 * scale_pa / std::pow(smallest_gap, 5);
    double below = min_fraction, above = edge;
    if (bare_slope(edge) > steepest_pa) {
      for (int n = 0; n < 60; ++n) {
        const double middle = 0.5 * (below + above);
        (bare_slope(middle) > steepest_pa ? above : below) = middle;
      }
    } else {
      below = std::max(edge, min_fraction + steepest_pa / stiff);
    }
    crossover_pressure_pa = bare(below);
    crossover = below;
    steepest = steepest_pa;
  }

  /// p [Pa] at a fraction [-]
  double at(double fraction) const {
    if (fraction <= crossover) return bare(fraction);
    return crossover_pressure_pa + steepest * (fraction - crossover);
  }
  /// dp/dalpha [Pa], at the floor of the gap from the left
  double slope(double fraction) const {
    return fraction <= crossover ? bare_slope(fraction) : steepest;
  }

 private:
  double gap(double fraction) const { return std::max(max_fraction - fraction, smallest_gap); }
  double bare(double fraction) const {
    const double over = std::max(fraction - min_fraction, 0.0), g = gap(fraction), g2 = g * g;
    return scale_pa * over * over / (g2 * g2 * g);
  }
  double bare_slope(double fraction) const {
    const double over = std::max(fraction - min_fraction, 0.0), g = gap(fraction), g2 = g * g;
    const double closing = max_fraction - fraction >= smallest_gap ? 5 * over / g : 0;
    return scale_pa * over * (2 + closing) / (g2 * g2 * g);
  }
};

}  // namespace sturz
