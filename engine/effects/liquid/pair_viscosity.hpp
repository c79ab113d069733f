// SPDX-License-Identifier: Apache-2.0
/// The part of a liquid's viscosity that acts between pairs.
///
/// Stress from a gradient over two spacings and its divergence over two more do not see a velocity
/// that alternates from layer to layer. Walls excite it, and nothing but pairs damps it: a film of
/// 20 layers under stress alone is 6 % off in steady flow. So Monaghan's viscosity between pairs
/// bears a tenth of the shear stress and is taken off it: their sum is the law's. It is never more,
/// whatever the liquid does: below its yield stress, too, and where it separates.
#pragma once

#include "engine/core/symmetric_tensor.hpp"
#include "engine/effects/liquid/settings.hpp"

#include <cmath>

namespace sturz {

class PairViscosity {
 public:
  explicit PairViscosity(const LiquidSettings& g)
      : per_alpha_(shear_per_alpha * g.smoothing_length * g.sound_speed * g.reference_density) {}

  /// What alpha = 1 would bear over the shear stress of the liquid, for fields::viscous_ratio [-].
  /// \param l  velocity gradient, rows dv_a [1/s] \param tau  shear stress after the step [Pa]
  double ratio(const double l[9], double tau) const {
    const double third = (l[0] + l[4] + l[8]) / 3;
    const Symmetric d{l[0] - third,        l[4] - third,        l[8] - third,
                      0.5 * (l[1] + l[3]), 0.5 * (l[5] + l[7]), 0.5 * (l[2] + l[6])};
    return std::fmin(none, per_alpha_ * 2 * std::sqrt(d.norm2()) / (tau + 1e-300));
  }

  struct Share {
    double alpha = 0;    ///< of the pairs' viscosity, in units of h c0 rho_0 [-]
    double carried = 0;  ///< of the deviator, by pairs in its place [-]
  };
  /// \param ratio  as above, of the step before
  static Share of(double ratio) {
    const double alpha = ratio * most > share ? share / ratio : most;
    return {alpha, alpha * ratio};
  }

  /// A ratio at which nothing acts.
  static constexpr double none = 1e30;

 private:
  static constexpr double share = 0.1;
  /// Beyond it the pairs' viscosity would need shorter steps than sound does.
  static constexpr double most = 1;
  /// Shear viscosity for alpha = 1 over h c0 rho_0: layers of a cubic lattice that slide over each
  /// other, mean over their offsets. 0.088 for the lattice itself and 0.1 for particles anywhere.
  static constexpr double shear_per_alpha = 0.0925;

  double per_alpha_;
};

}  // namespace sturz
