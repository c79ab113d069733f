// SPDX-License-Identifier: Apache-2.0
/// What the bed takes from a depth-averaged column: Coulomb with pore pressure, cohesion, and the
/// optional turbulent (Voellmy), laminar, Bingham and SamosAT terms.
#pragma once

#include <algorithm>
#include <cmath>

namespace sturz {

/// Shear stress at the bed over density and thickness is a deceleration:
///   Coulomb    mu (1 - r_u) g_n                  Hungr's form, docs/physics.md A.8
///   cohesion   c / (rho h)
///   Voellmy    g v^2 / (xi h)
///   laminar    3 eta v / (rho h^2)               docs/physics.md A.8 (Eq. 32)
///   Bingham    tau_b / (rho h) with 2 tau_b^3 - 3 (tau_y + 2 eta v/h) tau_b^2 + tau_y^3 = 0, the
///              depth-averaged velocity of a Bingham film (Laigle & Coussot 1997 [M])
///   SamosAT    mu (1 - r_u) g_n (1 + R_s0/(R_s0 + R_s)) + v^2 / (h (ln(h/R)/kappa + B)^2) with
///              R_s = v^2/((1 - r_u) g_n h), in place of Coulomb and Voellmy: docs/physics.md A.8
struct BasalResistance {
  double friction_coefficient = 0.4;  ///< mu [-]
  double pore_pressure_ratio = 0;     ///< r_u [-]
  double cohesion_pa = 0;             ///< c [Pa]
  double turbulent_coefficient = 0;   ///< xi [m/s^2]; 0: none
  double viscosity_pa_s = 0;          ///< eta [Pa s]; 0: none
  double yield_stress_pa = 0;         ///< tau_y [Pa]

  bool samosat = false;                ///< the four that follow count
  double fluidization_number = 0.222;  ///< R_s0 [-]
  double von_karman = 0.43;            ///< kappa [-]
  double roughness_m = 0.05;           ///< R [m]
  double profile_offset = 4.13;        ///< B [-]

  double effective_friction() const { return friction_coefficient * (1 - pore_pressure_ratio); }

  /// tau_b of a Bingham film that flows at mean speed v, at least tau_y [Pa]. With x = tau_y/tau_b
  /// the cubic is x^3 - (3 + a) x + 2 = 0, a = 6 eta v/(h tau_y): convex on 0..1, so Newton from
  /// below never overshoots. It starts at the better of two lower bounds, by the laws of fast flow
  /// and of slow flow, where the root is nearly double: 2 y^2 = a (1 - y) for y = 1 - x.
  double bingham_stress(double speed, double thickness) const {
    if (yield_stress_pa <= 0) return 3 * viscosity_pa_s * speed / thickness;
    const double a = 6 * viscosity_pa_s * speed / (thickness * yield_stress_pa);
    if (!(a > 0)) return yield_stress_pa;
    double x = std::max(2 / (3 + a), 1 - 2 * a / (std::sqrt(a * a + 8 * a) + a));
    for (int i = 0; i < 5; ++i) x -= (x * x * x - (3 + a) * x + 2) / (3 * x * x - (3 + a));
    return yield_stress_pa / std::min(1.0, x);
  }

  bool has_rate() const { return turbulent_coefficient > 0 || viscosity_pa_s > 0 || samosat; }

  /// How many times its friction the SamosAT bed has at this speed: two at rest, one when fast.
  double slowness(double speed, double normal_gravity, double thickness) const {
    const double pressure = (1 - pore_pressure_ratio) * normal_gravity * thickness;
    return pressure > 0 ? 1 + fluidization_number / (fluidization_number + speed * speed / pressure)
                        : 1;
  }

  /// Deceleration per speed by the terms that grow with speed [1/s].
  double rate(double speed, double thickness, double density, double gravity) const {
    double k = 0;
    if (samosat) {
      // Thinner than the roughness the profile's logarithm would turn negative.
      const double profile =
          std::log(std::max(1.0, thickness / roughness_m)) / von_karman + profile_offset;
      k += speed / (thickness * profile * profile);
    }
    if (turbulent_coefficient > 0) k += gravity * speed / (turbulent_coefficient * thickness);
    if (viscosity_pa_s > 0) {
      const double v = std::max(speed, 1e-9);  // Bingham: the rate is infinite at rest
      k += (bingham_stress(v, thickness) - yield_stress_pa) / (density * thickness * v);
    }
    return k;
  }

  /// Deceleration that can stop a column [m/s^2]; of all laws but SamosAT it is the same at any
  /// speed.
  double plastic(double normal_gravity, double thickness, double density, double speed) const {
    const double times = samosat ? slowness(speed, normal_gravity, thickness) : 1;
    return times * effective_friction() * normal_gravity +
           (cohesion_pa + yield_stress_pa) / (density * thickness);
  }
};

}  // namespace sturz
