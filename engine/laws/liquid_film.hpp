// SPDX-License-Identifier: Apache-2.0
/// The bed under a film of liquid that is too thin for its shear to be resolved.
#pragma once

#include "engine/laws/basal_resistance.hpp"
#include "engine/laws/herschel_bulkley.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

/// Shear stress at the bed, from the mean speed of a steady film with a free surface. With
/// x = tau_y/tau_b the speed of Herschel and Bulkley's law (Huang & Garcia 1998) is
///   v = n/(n + 1) H (tau_b/K)^(1/n) (1 - x)^(1 + 1/n) (1 - n/(2n + 1) (1 - x))
/// which is 3 K v/H for a Newtonian liquid (docs/physics.md A.8, Eq. 32) and BasalResistance's
/// cubic for Bingham's.
struct LiquidFilm {
  HerschelBulkley law;

  /// \param speed  mean over the film [m/s] \param thickness  H > 0 normal to the bed [m]
  /// \return tau_b >= tau_y [Pa]
  double bed_stress(double speed, double thickness) const {
    if (!(speed > 0)) return law.yield_stress;
    if (law.index == 1) {
      BasalResistance bingham;
      bingham.viscosity_pa_s = law.consistency;
      bingham.yield_stress_pa = law.yield_stress;
      return bingham.bingham_stress(speed, thickness);
    }
    return law.yield_stress + over_yield(speed, thickness);
  }

  /// A film's mean speed over the layer [0, `layer`] at the bed of a flow of depth H is that of a
  /// Newtonian film of this thickness under the same stress at the bed: 3 (D/2 - D^2/6H). It is H
  /// for the whole flow, and 3/2 D for a layer of even shear.
  static double equivalent_thickness(double layer, double depth) {
    const double d = std::min(layer, depth);
    return d * (1.5 - 0.5 * d / depth);
  }

 private:
  /// Newton's steps for log v over log y, y = tau_b - tau_y: concave, so that from below none
  /// oversteps.
  double over_yield(double speed, double thickness) const {
    const double n = law.index, power = 1 + 1 / n, c = n / (2 * n + 1);
    const double rate = speed * (n + 1) / (n * thickness);
    double y = law.consistency * std::pow(rate, n);
    for (int k = 0; k < 50; ++k) {
      const double tau = law.yield_stress + y, w = y / tau;
      const double miss = power * std::log(y) - std::log(tau) + std::log(1 - c * w) -
                          std::log(rate) - std::log(law.consistency) / n;
      const double slope = power - w - c * w * (1 - w) / (1 - c * w);
      y *= std::exp(-miss / slope);
      if (std::abs(miss) < 1e-12) break;
    }
    return y;
  }
};

}  // namespace sturz
