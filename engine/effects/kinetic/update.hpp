// SPDX-License-Identifier: Apache-2.0
/// Granular temperature and kinetic stress of one grain from n to n+1 (A.4, B.6, B.9).
#pragma once

#include "engine/core/symmetric_tensor.hpp"
#include "engine/effects/dense/settings.hpp"
#include "engine/laws/grain_states.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

/// Raw pointers to the columns that the update reads and writes.
struct KineticColumns {
  const double* mass = nullptr;
  const double* density_change = nullptr;  ///< at n+1
  double* theta = nullptr;                 ///< [m^2/s^2]
  double* stress[6] = {};                  ///< kinetic, xx yy zz xy yz zx, tension positive [Pa]
};

/// Sums and extremes over particles.
struct KineticTotals {
  double power = 0;        ///< V sigma_k : D dt [J]
  double granular = 0;     ///< 3/2 m theta, now [J]
  double conducted = 0;    ///< gained by conduction: zero but for rounding [J]
  double collisions = 0;   ///< put in by the stress or conduction and not there any more [J]
  double wave = 0;         ///< fastest sound of the colliding grains [m/s]
  double viscosity = 0;    ///< largest (2 mu + lambda)/rho [m^2/s]
  double diffusivity = 0;  ///< largest k_theta/(3/2 rho) [m^2/s]
  double theta = 0;        ///< largest [m^2/s^2]

  KineticTotals& operator+=(const KineticTotals& o) {
    power += o.power, granular += o.granular;
    conducted += o.conducted, collisions += o.collisions;
    wave = std::max(wave, o.wave), theta = std::max(theta, o.theta);
    viscosity = std::max(viscosity, o.viscosity);
    diffusivity = std::max(diffusivity, o.diffusivity);
    return *this;
  }
};

/// Share of the kinetic stresses. The last twentieth of w_k is left out, so that grains that are
/// all but dense (alpha > 0.587) count as dense in every sum.
inline double kinetic_share(double fraction, bool paper_switch) {
  if (paper_switch) return fraction < transition_fraction ? 1 : 0;
  constexpr double trace = 0.05;
  return std::fmax(0.0, (kinetic_weight(fraction) - trace) / (1 - trace));
}

/// KineticRecord::weight: sums are completed to the whole, but not from less than 0.4 of it. One
/// neighbour fills at most 1/23 of a support, so grains that have dilated further than `most` have
/// no sum to complete. Without this bound the first neighbour of such a grain would count hundreds
/// of times over: the support completeness is that of the step before, and was zero. \param
/// dilation_ratio  volume over that of the record; \param completeness  of the support
inline double pair_weight(double dilation_ratio, double completeness) {
  constexpr double most = 30;
  const double told = std::fmin(dilation_ratio, most);
  return told / std::sqrt(std::fmax(completeness * told, 0.4));
}

/// Speed of sound in colliding grains: c^2 = dp/drho at theta, and what compaction adds to it
/// (2/3 p^2/(rho^2 theta)), over theta.
inline double kinetic_wave2(const KineticTheory& law, const KineticCoefficients& k,
                            double fraction) {
  const double g0 = k.radial, e1 = 1 + law.restitution;
  const double filled = std::cbrt(std::min(fraction / law.max_fraction, 0.99));
  const double g0_slope = g0 * g0 * filled / (3 * std::max(fraction, 1e-12));
  const double bulk = k.pressure / (std::max(fraction, 1e-12) * law.grain_density);
  return 1 + 4 * e1 * fraction * g0 + 2 * e1 * fraction * fraction * g0_slope +
         2.0 / 3 * bulk * bulk;
}

class KineticUpdate {
 public:
  /// \param largest_theta  bound on theta: a third of the square of the largest speed [m^2/s^2]
  KineticUpdate(const GrainStressSettings& g, double dt, double largest_theta)
      : settings_(g), law_(*g.states->dilute), dt_(dt), largest_theta_(largest_theta) {}

  void apply(const KineticColumns& c, const SweepOutput& r, std::size_t begin, std::size_t end,
             KineticTotals& out) const {
    for (std::size_t i = begin; i < end; ++i) {
      const double fraction = settings_.states->reference_fraction * (1 + c.density_change[i]);
      const double share = kinetic_share(fraction, settings_.states->paper_switch);
      if (share > 0 || c.theta[i] > 0)
        advance(c, r, i, fraction, share, out);
      else
        for (double* s : c.stress) s[i] = 0;
    }
  }

 private:
  void advance(const KineticColumns& c, const SweepOutput& r, std::size_t i, double fraction,
               double share, KineticTotals& out) const {
    const double lxx = r.lxx[i], lyy = r.lyy[i], lzz = r.lzz[i], trace = lxx + lyy + lzz;
    const Symmetric rate{lxx,
                         lyy,
                         lzz,
                         0.5 * (double{r.lxy[i]} + r.lyx[i]),
                         0.5 * (double{r.lyz[i]} + r.lzy[i]),
                         0.5 * (double{r.lzx[i]} + r.lxz[i])};
    const Symmetric d = rate.plus(-trace / 3, {1, 1, 1, 0, 0, 0});
    KineticCoefficients k = kinetic_coefficients(law_, fraction, settings_.smoothing_length);
    const double density = fraction * law_.grain_density;
    const double theta0 = c.theta[i], s0 = std::sqrt(theta0);
    // Expanding grains may push less, but do not pull: the bulk viscosity stops at the pressure.
    if (trace > 0) k.bulk_viscosity = std::min(k.bulk_viscosity, k.pressure * s0 / trace);

    // Gains what the pair forces take from the motion, no more: see SweepOutput::pair_gradient.
    const Symmetric pair_gradient{r.pair_gradient[0][i], r.pair_gradient[1][i],
                                  r.pair_gradient[2][i], r.pair_gradient[3][i],
                                  r.pair_gradient[4][i], r.pair_gradient[5][i]};
    const double opened = pair_gradient.trace();
    double a = share *
               (2 * k.shear_viscosity * d.dot(pair_gradient) + k.bulk_viscosity * trace * opened) /
               (3 * density);
    double b = share * k.pressure * opened / (3 * density);
    if (a < 0) {  // uneven surroundings: it cools, as fast as its granular energy allows
      b -= a / std::fmax(s0, 1e-12);
      a = 0;
    }
    const double s1 = riccati_step(s0, a, b, k.dissipation / (3 * density), dt_);
    const double conducted = dt_ * r.conducted[i] / density;  // J/kg
    double theta1 = std::clamp(s1 * s1 + conducted / 1.5, 0.0, largest_theta_);
    // In a mass that has become dense the last trace fades as 1/t^2 only.
    if (share == 0 && theta1 < 1e-5 * largest_theta_) theta1 = 0;
    c.theta[i] = theta1;

    const double root = std::sqrt(theta1);
    const double push = share * (k.pressure * theta1 - k.bulk_viscosity * root * trace);
    const double drag = 2 * share * k.shear_viscosity * root;
    const Symmetric after = Symmetric{-push, -push, -push, 0, 0, 0}.plus(drag, d);
    const Symmetric before{c.stress[0][i], c.stress[1][i], c.stress[2][i],
                           c.stress[3][i], c.stress[4][i], c.stress[5][i]};
    c.stress[0][i] = after.xx, c.stress[1][i] = after.yy, c.stress[2][i] = after.zz;
    c.stress[3][i] = after.xy, c.stress[4][i] = after.yz, c.stress[5][i] = after.zx;

    const double mass = c.mass[i];
    const double work =
        mass / density * dt_ * 0.5 * (before.dot(pair_gradient) + after.dot(pair_gradient));
    out.power += work;
    out.granular += 1.5 * mass * theta1;
    out.conducted += mass * conducted;
    out.collisions += work + mass * conducted - 1.5 * mass * (theta1 - theta0);
    if (share == 0) return;
    out.theta = std::max(out.theta, theta1);
    out.wave = std::max(out.wave, root * std::sqrt(kinetic_wave2(law_, k, fraction)));
    out.viscosity = std::max(out.viscosity,
                             share * root * (2 * k.shear_viscosity + k.bulk_viscosity) / density);
    out.diffusivity = std::max(out.diffusivity, root * k.conductivity / (1.5 * density));
  }

  const GrainStressSettings& settings_;
  const KineticTheory& law_;
  double dt_, largest_theta_;
};

}  // namespace sturz
