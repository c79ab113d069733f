// SPDX-License-Identifier: Apache-2.0
/// Excess pore pressure over the depth of a sheared column (Terzaghi's consolidation with the
/// sources of a mixture; Pastor and others 2015 for one mesh per column). docs/physics.md F.7.
///
///   dp/dt = c_v d2p/dz2 + source          c_v = k/(mu alpha)       p = 0 where it drains
///   source = -gamma tan psi/alpha         gamma = 2 |u|/h, the same at all depths
///   squeezed out, volume per area and time = k/mu |dp/dz| where it drains
///
/// Nodes stand dz apart from the bed up; the uppermost is half of it below the surface. On a tight
/// bed the lowest stands on it and for half of dz, on a drained one it stands half of dz above.
/// With 1/alpha and psi of the base, a steady shear gives the parabola of pore_pressure.hpp with
/// the same pressure at the base.
#pragma once

#include "engine/laws/pore_pressure.hpp"

namespace sturz {

/// Where the nodes of a profile are, in shares of the thickness.
struct ProfileMesh {
  int nodes = 8;
  bool drained_bed = false;

  double spacing() const { return 1 / (drained_bed ? nodes : nodes - 0.5); }
  /// Height of node j over the bed.
  double height(int j) const { return (drained_bed ? j + 0.5 : j) * spacing(); }
  /// Share of the thickness that node j stands for.
  double weight(int j) const { return j == 0 && !drained_bed ? 0.5 * spacing() : spacing(); }
};

/// What drives a profile, at the pressure of its base.
struct ProfileRates {
  double diffusivity = 0;  ///< c_v [m^2/s]
  double source = 0;       ///< [Pa/s]
  /// How both follow the excess at the base, which decides sigma_e: near liquefaction that is
  /// hundreds of times faster than anything else.
  double diffusivity_slope = 0;  ///< [m^2/(s Pa)]
  double source_slope = 0;       ///< [1/s]
};

/// \param permeability k(m) [m^2]; \param effective_stress at the base, not negative [Pa];
/// \param speed |u| [m/s]; \param per_thickness 1/h of grains and pores [1/m]
[[gnu::always_inline]] inline ProfileRates profile_rates(const MixtureLaw& law, double m,
                                                         double permeability,
                                                         double effective_stress, double speed,
                                                         double per_thickness) {
  const double shear = 2 * speed * per_thickness;
  const Dilatancy d = dilatancy(law, m, shear, effective_stress);
  const double stiffness = law.stiffness(m, effective_stress);
  // Under a liquefied mass at rest nothing softens.
  const double softening = effective_stress + speed > 0 ? m / law.compressibility : 0;
  const double mobility = permeability / law.fluid_viscosity;
  return {mobility * stiffness, -shear * d.tangent * stiffness, -mobility * softening,
          shear * (d.tangent * softening - stiffness * d.slope)};
}

}  // namespace sturz
