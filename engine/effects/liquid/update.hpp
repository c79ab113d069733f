// SPDX-License-Identifier: Apache-2.0
/// Density and stress of one liquid particle from n to n+1, with its energies.
#pragma once

#include "engine/core/symmetric_tensor.hpp"
#include "engine/effects/liquid/settings.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

/// Sums over particles [J].
struct LiquidEnergies {
  double elastic = 0;    ///< stored after the step
  double power = 0;      ///< V sigma : D dt
  double viscous = 0;    ///< dissipated by flow
  double diffusion = 0;  ///< added by density diffusion and the bounds of the density

  LiquidEnergies& operator+=(const LiquidEnergies& o) {
    elastic += o.elastic;
    power += o.power;
    viscous += o.viscous;
    diffusion += o.diffusion;
    return *this;
  }
};

/// One particle: what the sweep says of its motion, and its state.
struct LiquidParticle {
  double l[9] = {};            ///< velocity gradient, rows dv_a [1/s]
  double diffusion = 0;        ///< of e [1/s]
  double grain_share = 0;      ///< X, see fields::grain_share [-]
  double slip_divergence = 0;  ///< div(alpha_p (v_p - v_f)) [1/s]
  double e = 0;                ///< rho/rho_0 - 1 [-]
  Symmetric s;                 ///< deviator of the stress [Pa]
};

/// Liquid that separates counts no further than `separation_threshold`, in pores as far as it does
/// not fill them: there 1 + e is the saturation.
inline double least_density_change(double grain_share) {
  constexpr double empty = -0.95, full_from = 0.3;  // share of the space that grains take
  const double alpha = grain_share / (1 + grain_share);
  const double inside = std::fmin(1.0, alpha / full_from);
  return LiquidSettings::separation_threshold +
         inside * (empty - LiquidSettings::separation_threshold);
}

/// How much a place counts as pores for what makes no sense there: 0 without grains .. 1 from X =
/// 0.1 on.
inline double in_pores(double grain_share) { return std::fmin(1.0, 10 * grain_share); }

class LiquidUpdate {
 public:
  LiquidUpdate(const LiquidSettings& g, double dt)
      : law_(g.law), settings_(g), dt_(dt), shear_(g.shear_modulus()) {}

  /// Moves p.e and p.s on; `out` is per mass over rho_0, as if the particle's mass were rho_0 m^3.
  void apply(LiquidParticle& p, LiquidEnergies& out) const {
    const double trace = p.l[0] + p.l[4] + p.l[8], pores = 1 + p.grain_share;
    // d(rho)/dt of the liquid itself: its own flow and that of the grains through it fill the same
    // space (docs/physics.md B.7).
    const double strain = dt_ * pores * (trace + p.slip_divergence);
    const double carried = strain > 0 ? (1 + p.e) / (1 + strain) - 1 : (1 + p.e) * (1 - strain) - 1;
    const double before = stored(p.e), squeezed = stored(carried);
    // What does not fill pores is not noise.
    const double noise = p.e < 0 ? 1 - in_pores(p.grain_share) : 1;
    const double diffused = carried + dt_ * noise * p.diffusion;
    const double e = std::fmax(diffused, least_density_change(p.grain_share));

    Symmetric s = rotated(p.s, 0.25 * dt_ * (p.l[7] - p.l[5]), 0.25 * dt_ * (p.l[2] - p.l[6]),
                          0.25 * dt_ * (p.l[3] - p.l[1]));
    const double third = trace / 3;
    const Symmetric d{p.l[0] - third,          p.l[4] - third,          p.l[8] - third,
                      0.5 * (p.l[1] + p.l[3]), 0.5 * (p.l[5] + p.l[7]), 0.5 * (p.l[2] + p.l[6])};
    const Symmetric t = s.plus(2 * shear_ * dt_, d);
    const double trial = std::sqrt(t.norm2());
    const double tau = trial > 0 ? law_at(e).relaxed(trial, shear_ * dt_) : 0;
    const double scale = trial > 0 ? tau / trial : 0;
    const double work = 0.5 * dt_ * (s.dot(d) + scale * t.dot(d));
    const double after = stored(e), half_inv = 0.5 / shear_;
    out.elastic += after + tau * tau * half_inv;
    out.power += work + squeezed - before;
    out.viscous += work - (tau * tau - s.norm2()) * half_inv;
    out.diffusion += after - squeezed;
    p.e = e;
    p.s = {scale * t.xx, scale * t.yy, scale * t.zz, scale * t.xy, scale * t.yz, scale * t.zx};
  }

 private:
  /// Spray carries no shear: the whole law in the liquid, nothing where it has separated. Scaled is
  /// the law, not the stress that it gives: that would be taken off anew with every step.
  HerschelBulkley law_at(double e) const {
    if (e >= 0) return law_;
    const double share = std::fmax(0.0, 1 - e / LiquidSettings::separation_threshold);
    return {share * law_.yield_stress, share * law_.consistency, law_.index};
  }
  double stored(double e) const { return settings_.reference_density * settings_.stored_at(e); }

  HerschelBulkley law_;
  LiquidSettings settings_;
  double dt_, shear_;
};

}  // namespace sturz
