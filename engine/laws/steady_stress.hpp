// SPDX-License-Identifier: Apache-2.0
/// Where the dilatancy of pore_pressure.hpp comes to rest: the effective stress under which shear
/// neither loosens nor tightens a mixture, m = m_crit/(1 + sqrt N) solved for sigma_e,
///   sigma_e = mu gamma/(m_crit/m - 1)^2 - rho_s gamma^2 delta^2, not negative.
#pragma once

#include "engine/laws/pore_pressure.hpp"

#include <cmath>
#include <limits>

namespace sturz {

/// Infinite from m_crit on: such a packing loosens under any stress.
/// \param m  solid fraction, above 0; \param shear_rate gamma [1/s] \return [Pa]
inline double steady_stress(const MixtureLaw& law, double m, double shear_rate) {
  const double root = law.critical_fraction / m - 1;  // sqrt N
  if (!(root > 0)) return std::numeric_limits<double>::infinity();
  const double collisions = law.grain_diameter * shear_rate;
  const double all = law.fluid_viscosity * shear_rate / (root * root);
  return std::fmax(0.0, all - law.solid_density * collisions * collisions);
}

}  // namespace sturz
