// SPDX-License-Identifier: Apache-2.0
/// The part of a liquid's viscosity that acts between pairs.
///
/// Stress from a gradient over two spacings and its divergence over two more do not see a velocity
/// that alternates from layer to layer. Walls excite it, and nothing but pairs damps it: a film of
/// 20 layers under stress alone is 6 % off in steady flow. So a tenth of the liquid's own viscosity
/// acts as Monaghan's viscosity between pairs and is taken off the stress: their sum is the law's.
#pragma once

#include "engine/effects/liquid/settings.hpp"

#include <cmath>

namespace sturz {

class PairViscosity {
 public:
  explicit PairViscosity(const LiquidSettings& g)
      : law_(g.law),
        per_alpha_(shear_per_alpha * g.smoothing_length * g.sound_speed * g.reference_density) {}

  struct Share {
    double alpha = 0;    ///< of the pairs' viscosity, in units of h c0 rho_0 [-]
    double carried = 0;  ///< of the deviator, by pairs in its place [-]
  };
  /// \param tau  shear stress sqrt(J2) by the liquid's law [Pa]
  Share at(double tau) const {
    const double over = tau - law_.yield_stress;
    if (!(over > 0)) return {law_.yield_stress > 0 ? most : newtonian_alpha(), 0};
    const double over_k = over / law_.consistency;
    const double rate = law_.index == 1 ? over_k : std::pow(over_k, 1 / law_.index);
    const double alpha = std::fmin(most, share * tau / (rate * per_alpha_));
    return {alpha, alpha * per_alpha_ * rate / tau};
  }

 private:
  static constexpr double share = 0.1;
  /// Beyond it the pairs' viscosity would need shorter steps than sound does.
  static constexpr double most = 1;
  /// Shear viscosity for alpha = 1 over h c0 rho_0: layers of a cubic lattice that slide over each
  /// other, mean over their offsets. 0.088 for the lattice itself and 0.1 for particles anywhere.
  static constexpr double shear_per_alpha = 0.0925;

  double newtonian_alpha() const {
    return law_.index == 1 ? std::fmin(most, share * law_.consistency / per_alpha_) : most;
  }

  HerschelBulkley law_;
  double per_alpha_;
};

}  // namespace sturz
