// SPDX-License-Identifier: Apache-2.0
/// Shear stress of a liquid with a yield stress (Herschel & Bulkley 1926): Newtonian with yield
/// stress 0 and index 1, Bingham with index 1.
#pragma once

#include <cmath>

namespace sturz {

/// tau = tau_y + K rate^n where it flows, up to tau_y where it does not.
struct HerschelBulkley {
  double yield_stress = 0;     ///< tau_y [Pa]
  double consistency = 0.001;  ///< K [Pa s^n]; the viscosity where n = 1
  double index = 1;            ///< n [-], 0 < n <= 1 shear thinning

  bool newtonian() const { return yield_stress == 0 && index == 1; }
  /// \param rate  sqrt(2 D':D') > 0 [1/s] \return shear stress [Pa]
  double stress(double rate) const {
    return yield_stress + (index == 1 ? consistency * rate : consistency * std::pow(rate, index));
  }
  /// Shear stress after an elastic trial, sqrt(J2) of the deviator: the root of
  /// trial - tau = G dt rate(tau), where rate(tau) is how fast the liquid flows under tau. With
  /// G dt large against K it is the law itself, whatever the step; with G dt small the liquid
  /// gives way within the time K/G.
  /// \param trial  sqrt(J2) after elastic strain [Pa] \param stiffness  G dt [Pa s], > 0
  double relaxed(double trial, double stiffness) const {
    if (trial <= yield_stress) return trial;
    if (index == 1)
      return (trial * consistency + stiffness * yield_stress) / (consistency + stiffness);
    return relaxed_by_steps(trial, stiffness);
  }

 private:
  /// Newton's steps for the rate r of (trial - tau_y) = K r^n + G dt r, concave in r: from the
  /// Bingham side they converge from below.
  double relaxed_by_steps(double trial, double stiffness) const {
    const double over = trial - yield_stress;
    double low = 0, high = over / stiffness;
    double rate = high;
    for (int k = 0; k < 60; ++k) {
      const double f = consistency * std::pow(rate, index) + stiffness * rate - over;
      (f > 0 ? high : low) = rate;
      const double slope = consistency * index * std::pow(rate, index - 1) + stiffness;
      double next = rate - f / slope;
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (std::abs(next - rate) <= 1e-14 * rate) break;
      rate = next;
    }
    return trial - stiffness * rate;
  }
};

}  // namespace sturz
