// SPDX-License-Identifier: Apache-2.0
/// The numbers of a weakly compressible liquid: law, resolution, stiffness, noise control.
#pragma once

#include "engine/core/constants.hpp"
#include "engine/effects/sweep/fused_sweep.hpp"
#include "engine/laws/herschel_bulkley.hpp"

#include <cmath>

namespace sturz {

struct LiquidSettings {
  HerschelBulkley law;
  double spacing = 1;               ///< initial particle spacing dx [m]
  double smoothing_length = 1.3;    ///< h [m]
  double reference_density = 1000;  ///< rho_0 of the liquid itself [kg/m^3]
  double sound_speed = 100;         ///< c0 of the equation of state [m/s]
  /// Where c0 may fall to while the liquid is slow; equal to `sound_speed`: it stays fixed [m/s].
  double least_sound_speed = 1e300;
  double speed_factor = 10;        ///< c0 over the present largest speed where it follows the flow
  double exponent = 7;             ///< gamma of Tait's equation [-]
  double viscosity = 0.02;         ///< artificial viscosity alpha_v [-]
  double density_diffusion = 0.1;  ///< delta of delta-SPH [-]
  double courant = 0.25;           ///< dt <= courant h/(c0 + |v|)
  double skin = 0.15;              ///< of the lists, in smoothing lengths
  /// Shear modulus over rho_0 c0^2: the liquid gives way to shear within the time K/G, far below
  /// that of its flow, so that its viscosity needs no time step of its own.
  double shear_stiffness = 0.25;
  InstructionSet instruction_set = InstructionSet::plain;  ///< chosen by assemble

  /// Liquid that separates counts in its neighbours' sums as if it had spread no further: a volume
  /// that grows with it would multiply every force on spray.
  static constexpr double separation_threshold = -0.02;

  double bulk_modulus() const { return reference_density * sound_speed * sound_speed; }
  double shear_modulus() const { return shear_stiffness * bulk_modulus(); }
  /// Tait's equation (Monaghan 1994), no suction: P = (rho_0 c0^2/gamma)((1 + e)^gamma - 1) for
  /// e = rho/rho_0 - 1 > 0, nothing below [Pa].
  double pressure_at(double e) const {
    return e > 0 ? bulk_modulus() / exponent * (raised(1 + e, exponent) - 1) : 0;
  }
  /// e >= 0 that carries a pressure [-].
  double density_change_at(double pressure) const {
    return pressure > 0 ? std::pow(1 + exponent * pressure / bulk_modulus(), 1 / exponent) - 1 : 0;
  }
  /// Energy stored per mass at e, from that at 0 [J/kg].
  double stored_at(double e) const {
    if (!(e > 0)) return 0;
    const double g = exponent, c2 = sound_speed * sound_speed, r = 1 + e;
    return c2 / g * ((raised(r, g) / r - 1) / (g - 1) + 1 / r - 1);
  }

 private:
  /// r^g; the usual exponent by products, twice for every particle and step.
  static double raised(double r, double g) {
    if (g != 7) return std::pow(r, g);
    const double r2 = r * r, r4 = r2 * r2;
    return r4 * r2 * r;
  }
};

}  // namespace sturz
