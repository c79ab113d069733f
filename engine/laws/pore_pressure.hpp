// SPDX-License-Identifier: Apache-2.0
/// Pore pressure at the base of a sheared, saturated mixture that dilates or contracts (Iverson &
/// George 2014; George & Iverson 2014). Equations, symbols and limits: docs/physics.md F.7.
///
///   d(p_e)/dt = -decay p_e + source      d(m)/dt = compaction p_e m      p_e = p_b - hydrostatic
///   decay     = k/(h mu) [3/(alpha h) - 3/2 rho_f g (rho - rho_f)/rho],  not negative
///   source    = -3 |u|/(alpha h) tan psi                                 none at rest
///   compaction = 2 k/(h^2 mu)
///   1/alpha   = m (sigma_e + sigma_0)/a        k = k_r exp(-(m - m_r)/0.04)
///   tan psi   = m - m_crit/(1 + sqrt N)        N = mu gamma/(rho_s gamma^2 delta^2 + sigma_e)
/// with the shear rate gamma = 2 |u|/h. All pure functions of one column's numbers, SI; without
/// branches, so that loops of them run four columns side by side.
#pragma once

#include "engine/core/plain_exp.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

/// Material of a mixture of grains and pore fluid.
struct MixtureLaw {
  double solid_density = 2700;          ///< rho_s [kg/m^3]
  double fluid_density = 1000;          ///< rho_f [kg/m^3]
  double fluid_viscosity = 0.005;       ///< mu [Pa s]
  double critical_fraction = 0.64;      ///< m_crit: solid fraction that slow shear leaves as it is
  double grain_diameter = 1e-3;         ///< delta [m]
  double permeability = 1e-10;          ///< k_r [m^2], at reference_fraction
  double reference_fraction = 0.6;      ///< m_r
  double compressibility = 0.05;        ///< a [-]
  double stress_offset = 1000;          ///< sigma_0 [Pa]
  static constexpr double fold = 0.04;  ///< change of m over which k falls to 1/e

  double density(double m) const { return m * solid_density + (1 - m) * fluid_density; }
  /// Where grains hardly touch, nothing parts them further: half of critical.
  double loosest_fraction() const { return 0.5 * critical_fraction; }
  double permeability_at(double m) const {
    return permeability * plain_exp((reference_fraction - m) * (1 / fold));
  }
  /// 1/alpha, stiffness of the grain skeleton [Pa].
  double stiffness(double m, double effective_stress) const {
    return m * (effective_stress + stress_offset) / compressibility;
  }
  /// Undrained change of p_b where gravity times thickness along the normal changes by
  /// `change_of_gh` [m^2/s^2]: (rho_f + 3 rho)/4 of it. \param bulk rho [kg/m^3]
  double undrained(double bulk, double change_of_gh) const {
    return 0.25 * (fluid_density + 3 * bulk) * change_of_gh;
  }
};

/// How much looser or denser than in steady shear a mixture is.
struct Dilatancy {
  double tangent = 0;          ///< tan psi = m - m_eq: it dilates where positive
  double steady_fraction = 0;  ///< m_eq
  double slope = 0;            ///< d(tan psi)/d(p_b) [1/Pa]
};

/// \param shear_rate gamma [1/s]; \param effective_stress sigma_e [Pa]; neither is negative
[[gnu::always_inline]] inline Dilatancy dilatancy(const MixtureLaw& law, double m,
                                                  double shear_rate, double effective_stress) {
  const double collisions = law.grain_diameter * shear_rate;
  const double all = law.solid_density * collisions * collisions + effective_stress;
  const double stress = all > 1e-300 ? all : 1e-300;
  const double root = std::sqrt(law.fluid_viscosity * shear_rate / stress), sum = 1 + root;
  const double sheared = law.critical_fraction / sum, loosest = law.loosest_fraction();
  const bool part = sheared < loosest;
  const double steady = part ? loosest : sheared;
  return {m - steady, steady, part ? 0 : 0.5 * sheared * root / (stress * sum)};
}

/// A column of the mixture as its pore pressure meets it.
struct WetColumn {
  double solid_fraction = 0.6;  ///< m
  double excess = 0;            ///< p_e [Pa]
  double thickness = 1;         ///< h of grains and pores, along the normal [m]
  double normal_stress = 0;     ///< sigma, of all that the column weighs [Pa]
  double hydrostatic = 0;       ///< of the water in it [Pa]
  double normal_gravity = 0;    ///< g [m/s^2]

  double effective_stress() const {
    const double borne = normal_stress - hydrostatic - excess;
    return borne > 0 ? borne : 0;
  }
};

/// Coefficients of the two equations above.
struct PoreRates {
  double decay = 0;       ///< [1/s]
  double source = 0;      ///< [Pa/s]
  double compaction = 0;  ///< [1/(Pa s)]
};

/// As published, for coefficients that stay as they are.
/// \param permeability k(m) [m^2]; \param speed |u| [m/s]; \param d dilatancy at this speed
[[gnu::always_inline]] inline PoreRates pore_rates(const MixtureLaw& law, const WetColumn& c,
                                                   double permeability, double speed,
                                                   const Dilatancy& d) {
  const double h = c.thickness, mobility = permeability / (h * law.fluid_viscosity);
  const double stiffness = 3 * law.stiffness(c.solid_fraction, c.effective_stress()) / h;
  const double bulk = law.density(c.solid_fraction);
  const double buoyancy =
      1.5 * law.fluid_density * c.normal_gravity * (bulk - law.fluid_density) / bulk;
  const double drains = stiffness - buoyancy;
  return {drains > 0 ? mobility * drains : 0, -speed * stiffness * d.tangent, 2 * mobility / h};
}

/// The same tangent to the curve: p_e changes sigma_e, and sigma_e changes 1/alpha and tan psi.
/// Near liquefaction that is hundreds of times faster than anything else. Decay may be negative:
/// a mixture that dilates stiffens itself.
[[gnu::always_inline]] inline PoreRates tangent_rates(const MixtureLaw& law, const WetColumn& c,
                                                      double permeability, double speed,
                                                      const Dilatancy& d) {
  PoreRates rates = pore_rates(law, c, permeability, speed, d);
  const double h = c.thickness, mobility = permeability / (h * law.fluid_viscosity);
  const double stiffness = 3 * law.stiffness(c.solid_fraction, c.effective_stress()) / h;
  const double softening = 3 * c.solid_fraction / (law.compressibility * h);  // -d(stiffness)/dp
  const double sheared = speed * (softening * d.tangent - stiffness * d.slope);
  // Under a liquefied mass at rest nothing softens.
  const double held = c.effective_stress() + speed, soft = held > 0 ? softening : 0;
  const double drains = rates.decay > 0 ? mobility : 0;
  const double slope = sheared + drains * soft * c.excess - rates.decay;
  const double change = rates.source - rates.decay * c.excess;
  rates.decay = -slope;
  rates.source = change - slope * c.excess;
  return rates;
}

/// After a time in which the coefficients stayed as they are.
struct PoreChange {
  double excess = 0;       ///< p_e at the end [Pa]
  double mean_excess = 0;  ///< over the time [Pa]
};

/// Exact and without a limit of the step:
///   p_e -> s/d + (p_e - s/d) exp(-d t).
[[gnu::always_inline]] inline PoreChange advance(const PoreRates& rates, double excess,
                                                 double time) {
  // What grows beyond e^30 is at its bounds long before.
  const double foreseen = rates.decay * time, x = foreseen < -30 ? -30 : foreseen;
  const Decay d = decay_over(x);
  const double gained = rates.source * time;
  return {excess + (gained - x * excess) * d.mean, excess * d.mean + gained * d.lag};
}

/// Share of friction that is left where grains hardly touch: 1/2 (1 + tanh 100 (m - 0.1)), one from
/// touching_fraction on.
constexpr double touching_fraction = 0.3;
inline double grains_touching(double solid_fraction) {
  return 1 / (1 + plain_exp(-200 * (solid_fraction - 0.1)));
}

/// tan(phi + psi) of the grain skeleton.
inline double mixture_friction(double tan_phi, double tan_psi, double touching = 1) {
  // Steep sums have no tangent; a friction beyond ten is a wall anyway.
  const double between = 1 - tan_phi * tan_psi, below = between > 0.1 ? between : 0.1;
  const double friction = (tan_phi + tan_psi) / below;
  return friction > 0 ? friction * touching : 0;
}

}  // namespace sturz
