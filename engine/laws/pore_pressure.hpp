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
/// with the shear rate gamma = 2 |u|/h. All pure functions of one column's numbers, SI.
#pragma once

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
    return permeability * std::exp((reference_fraction - m) / fold);
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

/// \param shear_rate gamma [1/s]; \param effective_stress sigma_e [Pa], not negative
inline Dilatancy dilatancy(const MixtureLaw& law, double m, double shear_rate,
                           double effective_stress) {
  if (!(shear_rate > 0)) return {m - law.critical_fraction, law.critical_fraction, 0};
  const double collisions = law.grain_diameter * shear_rate;
  const double stress = law.solid_density * collisions * collisions + effective_stress;
  const double loosest = law.loosest_fraction();
  if (!(stress > 0)) return {m - loosest, loosest, 0};
  const double root = std::sqrt(law.fluid_viscosity * shear_rate / stress), sum = 1 + root;
  const double steady = law.critical_fraction / sum;
  if (steady < loosest) return {m - loosest, loosest, 0};
  return {m - steady, steady, 0.5 * steady * root / (stress * sum)};
}

/// A column of the mixture as its pore pressure meets it.
struct WetColumn {
  double solid_fraction = 0.6;  ///< m
  double excess = 0;            ///< p_e [Pa]
  double thickness = 1;         ///< h of grains and pores, along the normal [m]
  double normal_stress = 0;     ///< sigma, of all that the column weighs [Pa]
  double hydrostatic = 0;       ///< of the water in it [Pa]
  double normal_gravity = 0;    ///< g [m/s^2]

  double effective_stress() const { return std::max(0.0, normal_stress - hydrostatic - excess); }
};

/// Coefficients of the two equations above.
struct PoreRates {
  double decay = 0;       ///< [1/s]
  double source = 0;      ///< [Pa/s]
  double compaction = 0;  ///< [1/(Pa s)]
};

/// As published, for coefficients that stay as they are.
/// \param permeability k(m) [m^2]; \param speed |u| [m/s]; \param d dilatancy at this speed
inline PoreRates pore_rates(const MixtureLaw& law, const WetColumn& c, double permeability,
                            double speed, const Dilatancy& d) {
  const double h = c.thickness, mobility = permeability / (h * law.fluid_viscosity);
  const double stiffness = 3 * law.stiffness(c.solid_fraction, c.effective_stress()) / h;
  const double bulk = law.density(c.solid_fraction);
  const double buoyancy =
      1.5 * law.fluid_density * c.normal_gravity * (bulk - law.fluid_density) / bulk;
  return {mobility * std::max(0.0, stiffness - buoyancy),
          speed > 0 ? -speed * stiffness * d.tangent : 0, 2 * mobility / h};
}

/// The same tangent to the curve: p_e changes sigma_e, and sigma_e changes 1/alpha and tan psi.
/// Near liquefaction that is hundreds of times faster than anything else. Decay may be negative:
/// a mixture that dilates stiffens itself.
inline PoreRates tangent_rates(const MixtureLaw& law, const WetColumn& c, double permeability,
                               double speed, const Dilatancy& d) {
  PoreRates rates = pore_rates(law, c, permeability, speed, d);
  if (!(c.effective_stress() > 0) && !(speed > 0)) return rates;
  const double h = c.thickness, mobility = permeability / (h * law.fluid_viscosity);
  const double stiffness = 3 * law.stiffness(c.solid_fraction, c.effective_stress()) / h;
  const double softening = 3 * c.solid_fraction / (law.compressibility * h);  // -d(stiffness)/dp
  double slope = -rates.decay;
  if (speed > 0) slope += speed * (softening * d.tangent - stiffness * d.slope);
  if (rates.decay > 0) slope += mobility * softening * c.excess;
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
inline PoreChange advance(const PoreRates& rates, double excess, double time) {
  // What grows beyond e^30 is at its bounds long before.
  const double x = std::max(-30.0, rates.decay * time);
  double first, second;  // (1 - e^-x)/x, (x - 1 + e^-x)/x^2
  if (std::abs(x) > 1e-3) {
    const double decayed = -std::expm1(-x);
    first = decayed / x, second = (1 - first) / x;
  } else {
    first = 1 - x * (0.5 - x * (1.0 / 6 - x / 24));
    second = 0.5 - x * (1.0 / 6 - x * (1.0 / 24 - x / 120));
  }
  const double gained = rates.source * time;
  return {excess + (gained - x * excess) * first, excess * first + gained * second};
}

/// tan(phi + psi) of the grain skeleton, and how much of it is left where grains hardly touch.
inline double mixture_friction(double tan_phi, double tan_psi, double solid_fraction) {
  // Steep sums have no tangent; a friction beyond ten is a wall anyway.
  const double below = std::max(0.1, 1 - tan_phi * tan_psi);
  const double touching =
      solid_fraction > 0.3 ? 1 : 0.5 * (1 + std::tanh(100 * (solid_fraction - 0.1)));
  return std::max(0.0, (tan_phi + tan_psi) / below) * touching;
}

}  // namespace sturz
