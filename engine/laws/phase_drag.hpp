// SPDX-License-Identifier: Apache-2.0
/// Drag between grains and liquid that move at two velocities, and the slip beyond which their
/// equations are not hyperbolic.
///
/// As a rate, force over mass of grains and slip [1/s], with shares a of grains (s) and liquid (f),
/// g = rho_f/rho_s, gravity G:
///   permeability  mu a_f^2 / (k a_s rho_s), k = k_r exp((m_r - a_s)/0.04)   (Darcy)
///   settling      a_f (1 - g) G / [U (P F + (1 - P) B)], P = a_s^4,
///                 F = g/180 (a_f/a_s)^3 Re, B = a_f^(M - 1), Re = rho_f U d/mu
///                 (Pudasaini 2012, as in r.avaflow, linear in the slip; its mass-flux term is 0,
///                 its exponent of P 4, so that F, which grows as a_s^-3, lets one grain alone
///                 settle at U)
/// with M of Richardson and Zaki (1954), and U of a single grain by Ferguson and Church (2004).
/// Beyond 0.3 <= a_s <= 0.8 (permeability) and 0.01 <= a_s <= 0.9 (settling) the rate at the bound
/// holds: the laws are made for packings, and both have no limit there.
#pragma once

#include "engine/core/vec.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {

/// Terminal speed of a natural grain, w = R g d^2/(18 nu + sqrt(0.75 R g d^3)) (Ferguson & Church
/// 2004, C1 = 18, C2 = 1). \param diameter [m] \param viscosity of the liquid [Pa s] \return [m/s]
inline double settling_speed(double diameter, double solid_density, double fluid_density,
                             double viscosity, double gravity) {
  const double r = gravity * (solid_density - fluid_density) / fluid_density;
  return r * diameter * diameter /
         (18 * viscosity / fluid_density + std::sqrt(0.75 * r * diameter * diameter * diameter));
}

/// Exponent of hindered settling by the grain's Reynolds number (Richardson & Zaki 1954).
inline double hindrance_exponent(double reynolds) {
  if (reynolds < 0.2) return 4.65;
  if (reynolds < 1) return 4.35 * std::pow(reynolds, -0.03);
  if (reynolds < 500) return 4.45 * std::pow(reynolds, -0.1);
  return 2.39;
}

struct PhaseDrag {
  double solid_density = 2600, fluid_density = 1000;  ///< [kg/m3]
  double fluid_viscosity = 0.005;                     ///< [Pa s]
  double permeability = 1e-10;                        ///< k_r [m2]; used where `settling` is 0
  double reference_fraction = 0.6;                    ///< m_r
  double settling = 0;                                ///< U of one grain [m/s]; 0: permeability
  double grain_diameter = 0.1;                        ///< d, for Re [m]

  double density_ratio() const { return fluid_density / solid_density; }

  /// Force over mass of grains and slip [1/s]. \param solids  share a_s of grains in the mixture
  double rate(double solids, double gravity) const {
    if (!(settling > 0)) {
      const double a = std::clamp(solids, 0.3, 0.8), pores = 1 - a;
      const double k = permeability * std::exp((reference_fraction - a) / 0.04);
      return fluid_viscosity * pores * pores / (k * a * solid_density);
    }
    const double a = std::clamp(solids, 0.01, 0.9), pores = 1 - a;
    const double g = density_ratio(), ratio = pores / a, packed = a * a * a * a;
    const double reynolds = fluid_density * settling * grain_diameter / fluid_viscosity;
    const double through = g / 180 * ratio * ratio * ratio * reynolds;
    const double falling = std::pow(pores, hindrance_exponent(reynolds) - 1);
    return pores * (1 - g) * gravity / (settling * (through * packed + (1 - packed) * falling));
  }

  /// Slip up to which all wave speeds are real, 2 sqrt((1 - a_s)(1 - g)/2) sqrt(G h): sufficient,
  /// not necessary (Pelanti, Bouchut & Mangeney 2008 [M]; eigenvalues of the one-dimensional
  /// system looked at for a_s 0.1 ... 0.9 and g 0.3 ... 0.6: the first complex pair lies at 1.01
  /// to 1.7 times this). Without pressure the two sets know of each other by drag alone and any
  /// slip will do. \param wave2  G h [m2/s2]
  double largest_slip(double solids, double wave2) const {
    if (!(wave2 > 0)) return std::numeric_limits<double>::infinity();
    return std::sqrt(2 * std::max(0.0, 1 - solids) * (1 - density_ratio()) * wave2);
  }
};

/// Grains and liquid at one place, before and after what gravity, pressure and bed do in a step.
struct SlippingPair {
  double grains = 0, liquid = 0;             ///< masses [kg]
  Vec3 slip_before{0, 0, 0}, slip{0, 0, 0};  ///< of the grains against the liquid [m/s]
  double spare = 0;                          ///< impulse that the bed below could still hold [N s]
  double rate = 0;                           ///< PhaseDrag::rate [1/s]
  double largest_slip = 0;                   ///< [m/s]
};

struct DragImpulse {
  Vec3 on_liquid{0, 0, 0};  ///< the grains take the opposite [N s]
  bool raised = false;      ///< more than the law's, for `largest_slip`
};

/// Slip that drag takes off in `steps` relaxation times: exact for a slip that decays while it is
/// driven evenly, and what it drives decays as exp(-steps). Where a step turns the slip round, the
/// decay of what is left.
inline Vec3 slip_taken(const Vec3& before, const Vec3& after, double steps) {
  if (!(steps > 0)) return Vec3(0, 0, 0);
  const double decayed = -std::expm1(-steps);
  if (before.dot(after) < 0) return decayed * after;
  const double driven = steps > 1e-5 ? 1 - decayed / steps : 0.5 * steps;
  return decayed * before + driven * (after - before);
}

/// Impulse of the drag over dt. Grains that the bed holds stay as long as it can: the liquid is
/// braked by them as by the bed itself.
inline DragImpulse drag_impulse(const SlippingPair& p, double dt) {
  DragImpulse out;
  if (!(p.grains > 0 && p.liquid > 0)) return out;
  const double reduced = p.grains * p.liquid / (p.grains + p.liquid);
  const double force = p.rate * p.grains * dt;  // per slip [kg]
  const auto taken = [&](double inertia) {
    Vec3 e = slip_taken(p.slip_before, p.slip, force / inertia);
    const Vec3 left = p.slip - e;
    const double length = left.norm();
    if (length > p.largest_slip) {
      out.raised = true;
      e += (1 - p.largest_slip / length) * left;
    }
    return e;
  };
  if (p.spare > 0) {
    const Vec3 alone = taken(p.liquid);
    const double needed = p.liquid * alone.norm();
    if (needed <= p.spare) {
      out.on_liquid = p.liquid * alone;
      return out;
    }
    out.raised = false;
  }
  const Vec3 e = taken(reduced);
  const double length = e.norm();
  if (!(length > 0)) return out;
  const double held = std::min(p.spare, p.liquid * length);
  out.on_liquid = ((held + reduced * (length - held / p.liquid)) / length) * e;
  return out;
}

}  // namespace sturz
