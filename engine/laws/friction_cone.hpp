// SPDX-License-Identifier: Apache-2.0
/// Which cone tau <= c + M p an internal friction angle stands for (docs/physics.md A.3).
#pragma once

#include "engine/laws/mu_i_rheology.hpp"

#include <cmath>
#include <limits>

namespace sturz {

/// Where the cone meets Mohr-Coulomb's tan(phi): in shear along a plane that carries p, or in plane
/// strain at constant volume, where tau is half the difference of the principal stresses and p
/// their mean in the plane.
enum class FrictionCone { simple_shear, plane_strain };

/// M of a friction coefficient tan(phi) [-]: tan(phi) along a plane, sin(phi) in plane strain.
///
/// The Drucker-Prager match 3 tan/sqrt(9 + 12 tan^2) of many codes (0.480 at 30 degrees) is for a
/// flow that dilates by its friction angle; here it would act as 28.7 degrees.
inline double cone_slope(FrictionCone cone, double friction) {
  return cone == FrictionCone::simple_shear ? friction
                                            : friction / std::sqrt(1 + friction * friction);
}

/// Cohesion on the same cone [Pa]: c along a plane, c cos(phi) in plane strain.
/// \param friction  tan(phi)
inline double cone_cohesion(FrictionCone cone, double friction, double cohesion) {
  return cone == FrictionCone::simple_shear ? cohesion
                                            : cohesion / std::sqrt(1 + friction * friction);
}

/// The law that grains yield by. Pore pressure r_u p leaves p' = (1 - r_u) p between the grains,
/// which both yields and sets the inertial number: tau_y = c + mu(I') p', I' = gamma d
/// sqrt(rho_p/p'). Over the total pressure p that is mu(I) with mu_s, mu_2 times 1 - r_u and I_0
/// times its square root.
/// \param typed  coefficients tan(phi) and cohesion along a plane, without pore pressure
/// \param pore_pressure_ratio  r_u inside, 0 to 1
inline MuIRheology yielding_law(const MuIRheology& typed, FrictionCone cone,
                                double pore_pressure_ratio) {
  const double left = 1 - pore_pressure_ratio;
  MuIRheology law = typed;
  law.static_friction = left * cone_slope(cone, typed.static_friction);
  law.dynamic_friction = left * cone_slope(cone, typed.dynamic_friction);
  law.inertial_number_scale *= std::sqrt(left);
  law.cohesion = cone_cohesion(cone, typed.static_friction, typed.cohesion);
  return law;
}

/// Friction angle of the Mohr-Coulomb material that yields alike in plane strain at constant volume
/// [rad]; infinite where none does: from M = 1 on no ratio of principal stresses yields.
inline double plane_strain_angle(double slope) {
  return slope < 1 ? std::asin(slope) : std::numeric_limits<double>::infinity();
}

/// Horizontal over vertical stress of a level mass at rest, 1 - sin(phi) (Jaky 1944), but no less
/// than the cone bears with both horizontal stresses alike: (sqrt 3 - M)/(sqrt 3 + 2 M). That binds
/// on the cone of plane strain from 39.4 degrees on.
/// \param slope  M
inline double pressure_ratio_at_rest(FrictionCone cone, double slope) {
  const double jaky =
      1 - (cone == FrictionCone::simple_shear ? slope / std::sqrt(1 + slope * slope) : slope);
  const double root3 = std::sqrt(3.0);
  return std::fmax(jaky, (root3 - slope) / (root3 + 2 * slope));
}

}  // namespace sturz
