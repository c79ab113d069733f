// SPDX-License-Identifier: Apache-2.0
/// How much of the artificial viscosity acts on a grain, and how much of its stress that replaces.
///
/// The viscosity is there for noise and sound, but in uniform shear it is a Newtonian fluid of
/// eta = alpha_v h c0 rho/10: more than mu(I) leaves in a slow slope or in a thin and fast front.
/// So it is held to a tenth of the friction where grains yield, and what it carries there is taken
/// off the stress, so that their sum is the friction law's. Where nothing yields it acts in full.
#pragma once

#include <algorithm>

namespace sturz {

struct ViscousShare {
  double acting = 1;   ///< of the artificial viscosity [-]
  double carried = 0;  ///< of the deviatoric stress, by the viscosity in its place [-]
};

/// \param ratio  eta times the rate of plastic shear, over the shear stress of the friction law [-]
inline ViscousShare viscous_share(double ratio) {
  constexpr double most = 0.1;    // of the friction
  constexpr double least = 0.02;  // so that grains without load do not fall through each other
  const double acting = ratio > most ? std::max(least, most / ratio) : 1;
  return {acting, std::min(1.0, ratio * acting)};
}

}  // namespace sturz
