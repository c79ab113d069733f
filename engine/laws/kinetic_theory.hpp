// SPDX-License-Identifier: Apache-2.0
/// Dilute grains: pressure, viscosity, conductivity and dissipation of colliding grains, and the
/// exact update of their granular temperature.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sturz {

/// Kinetic theory of Lun et al. as Gao et al. use it, Eqs. (3), (14)-(17), in the corrected forms
/// of A.4. Made for binary collisions of nearly elastic grains: e >= 0.7, alpha <= 0.5.
struct KineticTheory {
  double grain_density = 2600;  ///< rho_p [kg/m^3]
  double grain_diameter = 0.1;  ///< d_p [m]
  double restitution = 0.7;     ///< e [-]
  double max_fraction = 0.64;   ///< alpha_max [-]
};

/// Coefficients divided by their power of s = sqrt(theta), so that they exist at theta = 0.
struct KineticCoefficients {
  double radial;           ///< g0 [-]
  double pressure;         ///< p_k / theta [kg/m^3]
  double bulk_viscosity;   ///< lambda_p / s [kg/m^2]
  double shear_viscosity;  ///< (mu_col + mu_kin) / s [kg/m^2]
  double conductivity;     ///< k_theta / s [kg/m^2]
  double dissipation;      ///< gamma_theta / s^3 [kg/m^4]
};

/// With s = sqrt(theta), g0 = 1/(1 - (alpha/alpha_max)^(1/3)) at min(alpha, 0.99 alpha_max):
///   p_k     = alpha rho_p theta [1 + 2 (1+e) alpha g0]
///   lambda  = 4/3 alpha^2 rho_p d g0 (1+e) s/sqrt(pi)        mu_col = 3/5 lambda
///   mu_kin  = 10 sqrt(pi) rho_p d s/(96 (1+e) g0) [1 + 4/5 (1+e) g0 alpha]^2
///   k_theta = 150 sqrt(pi) rho_p d s/(384 (1+e) g0) [1 + 6/5 (1+e) g0 alpha]^2 + 3/2 lambda
///   gamma   = 12 (1-e^2) alpha^2 rho_p g0 s^3/(d sqrt(pi))
///
/// `longest_path` is this project's own bound, not in the paper. mu_kin and the first part of
/// k_theta are what grains carry along their mean free path l = d/(6 sqrt(2) alpha g0). As alpha
/// falls they tend to constants, so mu/(alpha rho_p) ~ l s grows without bound and takes the time
/// step with it, although grains without neighbours within a smoothing length do not exchange
/// momentum at that rate. Where l is longer than the bound these parts are multiplied by
/// longest_path/l; then mu/(alpha rho_p) tends to 5 sqrt(2 pi) longest_path s/(8 (1+e)).
///
/// \param fraction      alpha, 0 <= alpha < 1 [-]
/// \param longest_path  bound on the mean free path, > 0 [m]; infinity: none
inline KineticCoefficients kinetic_coefficients(
    const KineticTheory& law, double fraction,
    double longest_path = std::numeric_limits<double>::infinity()) {
  const double root_pi = 1 / std::numbers::inv_sqrtpi;
  const double e1 = 1 + law.restitution, d = law.grain_diameter, rho = law.grain_density;
  const double g0 = 1 / (1 - std::cbrt(std::min(fraction / law.max_fraction, 0.99)));
  const double collisions = e1 * g0 * fraction;
  // A floor far below any particle's fraction keeps 0/0 and infinity/infinity out.
  const double path = d / (6 * std::numbers::sqrt2 * std::max(fraction, 1e-12) * g0);
  const double streaming = root_pi * rho * d / (e1 * g0 * std::max(1.0, path / longest_path));
  const double shear = 1 + 0.8 * collisions, conducting = 1 + 1.2 * collisions;

  KineticCoefficients k;
  k.radial = g0;
  k.pressure = fraction * rho * (1 + 2 * collisions);
  k.bulk_viscosity = 4.0 / 3 * fraction * rho * d * collisions / root_pi;
  k.shear_viscosity = 0.6 * k.bulk_viscosity + 10.0 / 96 * streaming * shear * shear;
  k.conductivity = 1.5 * k.bulk_viscosity + 150.0 / 384 * streaming * conducting * conducting;
  k.dissipation = 12 * (1 - law.restitution) * fraction * rho * collisions / (d * root_pi);
  return k;
}

/// Exact solution of ds/dt = a - b s - c s^2 with frozen coefficients after dt (B.6).
///
/// With D = sqrt(b^2 + 4ac) and E = exp(-D dt), multiplied out so that no term is negative:
///   s = [s0 ((D-b) + (D+b) E) + 2a (1-E)] / [(D+b) + (D-b) E + 2 c s0 (1-E)].
/// The smaller of D-b and D+b is taken as 4ac over the larger: nothing cancels, s >= 0 always.
///
/// \param s0  >= 0 [m/s]; \param a production >= 0 [m/s^2]; \param b [1/s], any sign;
/// \param c   dissipation >= 0 [1/m]; \param dt >= 0 [s]
/// \return s(dt) [m/s]; infinite only where c = 0 and exp(-b dt) overflows
inline double riccati_step(double s0, double a, double b, double c, double dt) {
  const double root = std::sqrt(b * b + 4 * a * c);
  if (!(root > 0)) return (s0 + a * dt) / (1 + c * s0 * dt);  // exact: b = 0, and a or c is
  const double larger = root + std::abs(b), smaller = 4 * a * c / larger;
  const double minus = b < 0 ? larger : smaller;                             // D - b
  const double plus = b < 0 ? smaller : larger;                              // D + b
  const double left = std::exp(-root * dt), gone = -std::expm1(-root * dt);  // E and 1 - E
  const double above = s0 * (minus + plus * left) + 2 * a * gone;
  const double below = plus + minus * left + 2 * c * s0 * gone;
  return above > 0 ? above / below : 0;
}

}  // namespace sturz
