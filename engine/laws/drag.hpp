// SPDX-License-Identifier: Apache-2.0
/// Drag of a liquid on grains from packed to alone (docs/physics.md A.6): Ergun (1952) in packings,
/// Wen & Yu (1966) with Schiller and Naumann's coefficient (1935) among few, and Huilin and
/// Gidaspow's switch (2003) between them.
///
/// With shares a_p of grains and a_f = 1 - a_p of pores, slip u, force per volume of mixture and
/// slip [kg/(m^3 s)]:
///   Ergun    beta = 150 a_p^2 mu/(a_f d^2) + 1.75 a_p rho u/d
///   Wen-Yu   beta = 3/4 C_D a_p a_f^-1.65 rho u/d,  Re = a_f rho d u/mu,
///            C_D = 24/Re (1 + 0.15 Re^0.687) below Re = 1000, 0.44 above
///   blend    beta = (1 - phi) Ergun + phi Wen-Yu, phi = f(a_p)/f(0),
///            f = atan(262.5 (0.2 - a_p))/pi + 1/2
/// The printed switch is f alone, which leaves 0.6 % of Ergun's law to a grain with no other near
/// it and slows it by up to 1.3 %; over its value there it is 1, and differs from f by 0.6 %.
/// The law belongs to the form of the equations in which both phases take their share of the
/// pressure gradient (Model A of Anderson & Jackson 1967).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz {

struct GranularDrag {
  double diameter = 0.01;   ///< d of the grains [m]
  double density = 1000;    ///< rho of the liquid itself [kg/m^3]
  double viscosity = 1e-3;  ///< mu [Pa s]

  static constexpr double least_pores = 0.1;  ///< a_f beyond which the law at the bound holds

  /// beta/a_p of a packing: force per volume of grains and slip [kg/(m^3 s)].
  double ergun(double solids, double slip) const {
    const double pores = std::max(1 - solids, least_pores);
    return 150 * solids * viscosity / (pores * diameter * diameter) +
           1.75 * density * slip / diameter;
  }
  /// beta/a_p of single grains, finite without slip.
  double wen_yu(double solids, double slip) const {
    const double pores = std::max(1 - solids, least_pores);
    const double reynolds = pores * density * diameter * slip / viscosity;
    if (reynolds >= 1000) return 0.33 * density * slip / diameter * std::pow(pores, -1.65);
    return 18 * viscosity / (diameter * diameter) * std::pow(pores, -2.65) *
           (1 + 0.15 * std::pow(reynolds, 0.687));
  }
  /// phi: 1 for a grain alone, 0 in a packing.
  static double dispersion(double solids) {
    const auto f = [](double a) { return std::atan(262.5 * (0.2 - a)) / std::numbers::pi + 0.5; };
    static const double alone = f(0);
    return f(solids) / alone;
  }
  /// beta/a_p of the blend at one share of grains, for any slip: what does not depend on it is
  /// looked up once.
  class AtShare {
   public:
    AtShare(const GranularDrag& law, double solids) {
      const double pores = std::max(1 - solids, least_pores), phi = dispersion(solids);
      const double through = std::pow(pores, -1.65);
      packed_ = (1 - phi) * law.ergun(solids, 0);
      inertial_ = (1 - phi) * 1.75 * law.density / law.diameter;
      slow_ = phi * 18 * law.viscosity / (law.diameter * law.diameter) * through / pores;
      fast_ = phi * 0.33 * law.density / law.diameter * through;
      per_slip_ = pores * law.density * law.diameter / law.viscosity;
    }
    /// \param slip |u| [m/s] \return [kg/(m^3 s)]
    double operator()(double slip) const {
      const double reynolds = per_slip_ * slip;
      const double single =
          reynolds < 1000 ? slow_ * (1 + 0.15 * std::pow(reynolds, 0.687)) : fast_ * slip;
      return packed_ + inertial_ * slip + single;
    }

   private:
    double packed_, inertial_, slow_, fast_, per_slip_;
  };
  /// beta/a_p of the blend [kg/(m^3 s)]. \param solids a_p; \param slip |u| [m/s]
  double per_grain_volume(double solids, double slip) const { return AtShare(*this, solids)(slip); }
  /// beta [kg/(m^3 s)].
  double exchange(double solids, double slip) const {
    return solids * per_grain_volume(solids, slip);
  }
};

}  // namespace sturz
