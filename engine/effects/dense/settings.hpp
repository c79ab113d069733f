// SPDX-License-Identifier: Apache-2.0
/// The numbers of the dense grain stress: law, resolution, stiffness, noise control.
#pragma once

#include "engine/core/constants.hpp"
#include "engine/effects/kinetic/settings.hpp"
#include "engine/effects/sweep/fused_sweep.hpp"
#include "engine/laws/friction_cone.hpp"
#include "engine/laws/mu_i_rheology.hpp"

#include <cmath>
#include <optional>

namespace sturz {

struct GrainStressSettings {
  MuIRheology law;                                          ///< as grains yield, see yielding_law()
  FrictionCone friction_cone = FrictionCone::simple_shear;  ///< that `law` was made for
  std::optional<GrainStatesSettings> states;                ///< absent: every grain is dense
  double spacing = 1;                                       ///< initial particle spacing dx [m]
  double smoothing_length = 1.3;                            ///< h [m]
  double reference_density = 1560;                          ///< rho_ref = alpha_init rho_p [kg/m^3]
  double sound_speed = 100;  ///< c0 of compressional waves, sqrt((K + 4G/3)/rho) [m/s]
  /// Where c0 may fall to while the mass is slow; equal to `sound_speed`: it stays fixed [m/s].
  double least_sound_speed = 1e300;
  double speed_factor = 10;        ///< c0 over the present largest speed where it follows the flow
  double poisson_ratio = 0.3;      ///< nu, sets G/K [-]
  double viscosity = 0.1;          ///< artificial viscosity alpha_v [-]
  double density_diffusion = 0.1;  ///< delta [-]
  double stress_smoothing = 0.01;  ///< zeta [-]
  double courant = 0.25;           ///< dt <= courant h/(c0 + |v|)
  double skin = 0.15;              ///< of the lists, in smoothing lengths
  InstructionSet instruction_set = InstructionSet::plain;  ///< chosen by assemble

  /// Grains whose density fell this far below the reference have dilated: they carry no shear, and
  /// count in their neighbours' sums as if they had dilated no further. A volume that grows with
  /// the dilation would multiply every force on a grain that has left the mass.
  static constexpr double separation_threshold = -0.02;
  /// Smoothing runs in every so many-th step, as many times as strong: the same for a fraction of
  /// the cost.
  static constexpr int smoothing_interval = 16;
  /// Below this speed grains count as resting: smoothing fades out (it would let a pile creep) and
  /// a weak drag takes over (docs/physics.md B.13, I4) [m/s].
  double rest_speed() const { return 1e-3 * std::sqrt(standard_gravity * smoothing_length); }
  /// Time of the drag at rest [s]: a net acceleration above rest_speed/rest_time still starts a
  /// slide (about 0.001 g).
  double rest_time() const { return 50 * smoothing_length / sound_speed; }
  /// p_c of the smoothed ratio s/(p + p_c): cohesion, and a trace of the pressure of one layer so
  /// that unloaded grains stay finite [Pa].
  double ratio_floor() const {
    return 0.02 * reference_density * standard_gravity * spacing +
           law.cohesion / std::fmax(0.1, law.static_friction);
  }
  /// Nearer to the ground than this a grain lies on it [m]: it rests at half a spacing.
  double touching_distance() const { return 0.6 * spacing; }
  double shear_to_bulk() const { return 3 * (1 - 2 * poisson_ratio) / (2 * (1 + poisson_ratio)); }
  double bulk_modulus() const {
    return reference_density * sound_speed * sound_speed / (1 + 4.0 / 3.0 * shear_to_bulk());
  }
  double shear_modulus() const { return shear_to_bulk() * bulk_modulus(); }
  /// What the artificial viscosity is in uniform shear [Pa s]: alpha_v h c0/10 in three dimensions
  /// (Monaghan 2005; docs/physics.md B.4).
  double shear_viscosity() const {
    return 0.1 * viscosity * smoothing_length * sound_speed * reference_density;
  }

  /// Contact pressure at a relative density change [Pa].
  double pressure_at(double e) const {
    const double squeezed = bulk_modulus() * std::fmax(0.0, e);
    return states ? squeezed + states->friction.at(states->reference_fraction * (1 + e)) : squeezed;
  }
  /// Relative density change >= 0 that carries a pressure; 0 where the frictional pressure alone
  /// does.
  double density_change_at(double pressure) const {
    double e = std::fmax(0.0, pressure / bulk_modulus());
    if (!states) return e;
    if (pressure_at(0) >= pressure) return 0;
    double low = 0, high = e;  // the frictional part only takes load off
    for (int n = 0; n < 60 && high - low > 1e-15; ++n) {
      e = 0.5 * (low + high);
      (pressure_at(e) > pressure ? high : low) = e;
    }
    return e;
  }
};

}  // namespace sturz
