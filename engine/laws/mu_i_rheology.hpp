// SPDX-License-Identifier: Apache-2.0
/// Dense grains: elastic below yield, mu(I) above it, by a closed-form return (B.5).
#pragma once

#include <cmath>

namespace sturz {

/// tau_y = c + mu(I) p, mu(I) = mu_s + (mu_2 - mu_s) / (I_0/I + 1), I = gamma d / sqrt(p/rho_p).
/// Gao et al. Eqs. (11)-(13) with the corrections of docs/physics.md A.3; Jop et al. (2006).
struct MuIRheology {
  double static_friction = 0.38;       ///< mu_s [-]
  double dynamic_friction = 0.64;      ///< mu_2 [-]
  double inertial_number_scale = 0.3;  ///< I_0 [-]
  double grain_diameter = 0.1;         ///< d_p [m]
  double grain_density = 2600;         ///< rho_p [kg/m^3]
  double cohesion = 0;                 ///< c [Pa]
};

/// Equivalent shear stress after the return [Pa].
///
/// tau = tau_tr - G dt gamma_p with I = I_0 (tau - S_0)/(S_2 - tau) gives tau^2 - B tau + H = 0;
/// the smaller root is taken in the cancellation-free form 2H / (B + sqrt(B^2 - 4H)).
/// Exact in one step for any dt.
///
/// \param trial    tau of the elastic predictor, >= 0                [Pa]
/// \param pressure p >= 0                                            [Pa]
/// \param slowness G dt I_0 / (d_p sqrt(rho_p)), >= 0                [Pa^(1/2)]
inline double yield_return(const MuIRheology& law, double trial, double pressure, double slowness) {
  const double s0 = law.cohesion + law.static_friction * pressure;
  const double s2 = law.cohesion + law.dynamic_friction * pressure;
  const double a = slowness * std::sqrt(pressure);
  const double b = s2 + trial + a, h = s2 * trial + s0 * a;
  // B^2 - 4H = (S_2 - tau_tr)^2 + a (a + 2 S_2 + 2 tau_tr - 4 S_0) >= 0 above yield, since
  // S_0 <= S_2, tau_tr; rounding may still take it below zero when all are equal.
  const double square = b * b - 4 * h;
  const double root = std::sqrt(square > 0 ? square : 0);
  return trial > s0 ? 2 * h / (b + root) : trial;
}

/// mu(I) at a given shear rate, for tests and reports.
inline double friction_at(const MuIRheology& law, double inertial_number) {
  if (inertial_number <= 0) return law.static_friction;
  return law.static_friction + (law.dynamic_friction - law.static_friction) /
                                   (law.inertial_number_scale / inertial_number + 1);
}

}  // namespace sturz
