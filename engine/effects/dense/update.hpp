// SPDX-License-Identifier: Apache-2.0
/// Density and stress of one dense particle from n to n+1 (docs/physics.md B.5), with its energies.
#pragma once

#include "engine/core/symmetric_tensor.hpp"
#include "engine/effects/dense/packing.hpp"
#include "engine/effects/dense/settings.hpp"
#include "engine/effects/dense/stored_energy.hpp"
#include "engine/effects/dense/viscous_share.hpp"
#include "engine/effects/sweep/fused_sweep.hpp"

#include <cmath>

namespace sturz {

/// Raw pointers to the columns that the update reads and writes.
struct StressColumns {
  const double* mass = nullptr;
  double *vx = nullptr, *vy = nullptr, *vz = nullptr;
  double* density_change = nullptr;
  double* stress[6] = {};  ///< of contacts, xx yy zz xy yz zx [Pa], tension positive
  /// What the artificial viscosity would carry, over the friction of yielding grains [-]
  double* viscous_ratio = nullptr;
  const float* distance = nullptr;      ///< to the ground [m]; where grains may disperse
  const std::uint8_t* state = nullptr;  ///< GrainState at n; read by the paper's switch only
};

/// Sums over particles [J].
struct StressEnergies {
  double elastic = 0;     ///< stored after the step
  double frictional = 0;  ///< added to what the frictional pressure stores
  double power = 0;       ///< V sigma : D dt
  double plastic = 0;     ///< dissipated by the return
  double diffusion = 0;   ///< added by density diffusion and stress smoothing
  double rest = 0;        ///< taken by the drag at rest

  StressEnergies& operator+=(const StressEnergies& o) {
    elastic += o.elastic;
    frictional += o.frictional;
    power += o.power;
    plastic += o.plastic;
    diffusion += o.diffusion;
    rest += o.rest;
    return *this;
  }
};

class StressUpdate {
 public:
  /// \param smooth  whether this step's sweep brought rates of the stress ratio
  StressUpdate(const GrainStressSettings& g, double dt, bool smooth)
      : law_(g.law),
        smooth_(smooth),
        floor_(g.ratio_floor()),
        inv_rest_speed2_(1 / (g.rest_speed() * g.rest_speed())),
        rest_drag_(std::fmin(1.0, dt / g.rest_time())),
        bulk_(g.bulk_modulus()),
        shear_(g.shear_modulus()),
        half_inv_bulk_(0.5 / bulk_),
        half_inv_shear_(0.5 / shear_),
        inv_density_(1 / g.reference_density),
        dt_(dt),
        viscous_(g.shear_viscosity() / (shear_ * dt)),
        touching_(static_cast<float>(g.touching_distance())),
        slowness_(shear_ * dt * g.law.inertial_number_scale /
                  (g.law.grain_diameter * std::sqrt(g.law.grain_density))) {}

  /// Particles [begin, end). One branch-free body per particle, so that the compiler puts four of
  /// them side by side.
  void apply(const StressColumns& c, const SweepOutput& rate, std::size_t begin, std::size_t end,
             StressEnergies& out) const {
    apply(DensePacking{bulk_}, c, rate, begin, end, out);
  }
  /// The same with another law of pressure and density, see packing.hpp.
  template <class Packing>
  void apply(const Packing& packing, const StressColumns& c, const SweepOutput& rate,
             std::size_t begin, std::size_t end, StressEnergies& out) const {
    if (smooth_)
      range<true>(packing, c, rate, begin, end, out);
    else
      range<false>(packing, c, rate, begin, end, out);
  }

 private:
  template <bool smooth, class Packing>
  void range(const Packing packing, const StressColumns& c, const SweepOutput& r, std::size_t begin,
             std::size_t end, StressEnergies& out) const {
    double elastic = 0, frictional = 0, power = 0, plastic = 0, diffusion = 0, resting = 0;
    // Pointers in locals: the vectoriser does not look through the structs.
    const float *r_lxx = r.lxx, *r_lxy = r.lxy, *r_lxz = r.lxz;
    const float *r_lyx = r.lyx, *r_lyy = r.lyy, *r_lyz = r.lyz;
    const float *r_lzx = r.lzx, *r_lzy = r.lzy, *r_lzz = r.lzz, *r_diffusion = r.diffusion;
    const float *r_xx = r.smooth[0], *r_yy = r.smooth[1], *r_zz = r.smooth[2];
    const float *r_xy = r.smooth[3], *r_yz = r.smooth[4], *r_zx = r.smooth[5];
    const float *r_completeness = r.support_completeness, *c_distance = c.distance;
    const float touching = touching_;
    const double* mass = c.mass;
    const std::uint8_t* c_state = c.state;
    double* c_ratio = c.viscous_ratio;
    double *density_change = c.density_change, *c_vx = c.vx, *c_vy = c.vy, *c_vz = c.vz;
    double *s_xx = c.stress[0], *s_yy = c.stress[1], *s_zz = c.stress[2];
    double *s_xy = c.stress[3], *s_yz = c.stress[4], *s_zx = c.stress[5];
    const MuIRheology law = law_;
    const double dt = dt_, bulk = bulk_, shear = shear_, slowness = slowness_, floor = floor_;
    const double inv_rest_speed2 = inv_rest_speed2_, rest_drag = rest_drag_;
    const double half_inv_bulk = half_inv_bulk_, half_inv_shear = half_inv_shear_;
    const double inv_density = inv_density_, viscous = viscous_;
    const double held = law.cohesion > 0 ? 0 : -1;  // density_change
#pragma omp simd reduction(+ : elastic, frictional, power, plastic, diffusion, resting)
    for (std::size_t i = begin; i < end; ++i) {
      const double lxx = r_lxx[i], lxy = r_lxy[i], lxz = r_lxz[i];
      const double lyx = r_lyx[i], lyy = r_lyy[i], lyz = r_lyz[i];
      const double lzx = r_lzx[i], lzy = r_lzy[i], lzz = r_lzz[i];
      const double trace = lxx + lyy + lzz;

      // Density on the continuity equation, cut at zero pressure in tension.
      const double e0 = density_change[i];
      double diffused = dt * r_diffusion[i], e1;
      double squeezed_by;     // de by the continuity equation alone
      double p0, p1;          // of contacts
      double q0 = 0, q1 = 0;  // the frictional part of it
      if constexpr (Packing::dilates) {
        const double carried = packing.carried(e0, dt * trace);
        e1 = packing.bounded(carried + diffused, r_completeness[i], c_distance[i] < touching);
        diffused = e1 - carried;
        squeezed_by = carried - e0;
        p0 = -(s_xx[i] + s_yy[i] + s_zz[i]) / 3;
        p1 = packing.pressure(e1, p0, c_state ? c_state[i] : std::uint8_t{0});
        q0 = p0 - (e0 > 0 ? bulk * e0 : 0), q1 = p1 - (e1 > 0 ? bulk * e1 : 0);
      } else {
        squeezed_by = -dt * (1 + e0) * trace;
        e1 = packing.bounded(e0 + squeezed_by + diffused);
        p0 = packing.pressure(e0), p1 = packing.pressure(e1);
      }
      density_change[i] = e1;

      // Drag on loaded grains that hardly move: 0 at rest .. 1 in motion.
      const double vx = c_vx[i], vy = c_vy[i], vz = c_vz[i];
      const double v2 = vx * vx + vy * vy + vz * vz, relative2 = v2 * inv_rest_speed2;
      const double motion = relative2 < 1 ? relative2 : 1;
      const double keep = p1 > 0 ? 1 - (1 - motion) * rest_drag : 1;
      c_vx[i] = keep * vx, c_vy[i] = keep * vy, c_vz[i] = keep * vz;
      resting += 0.5 * mass[i] * v2 * (1 - keep * keep);

      Symmetric s{s_xx[i] + p0, s_yy[i] + p0, s_zz[i] + p0, s_xy[i], s_yz[i], s_zx[i]};
      double smoothed = 0;
      if constexpr (smooth) {
        const double before = s.norm2();
        const double weight = packing.smooths(e0, p0, law) ? dt * (p0 + floor) * motion : 0;
        s = s.plus(weight, {r_xx[i], r_yy[i], r_zz[i], r_xy[i], r_yz[i], r_zx[i]});
        smoothed = s.norm2() - before;
      }
      s = rotated(s, 0.25 * dt * (lzy - lyz), 0.25 * dt * (lxz - lzx), 0.25 * dt * (lyx - lxy));

      // Elastic trial, then the closed-form return to the yield surface.
      const double third = trace / 3;
      const Symmetric d{lxx - third,       lyy - third,       lzz - third,
                        0.5 * (lxy + lyx), 0.5 * (lyz + lzy), 0.5 * (lzx + lxz)};
      const Symmetric t = s.plus(2 * shear * dt, d);
      const double trial = std::sqrt(t.norm2());
      const double kept = yield_return(packing.yielding(law, e1), trial, p1, slowness);
      const double tau = packing.carries_shear(e1) ? kept : 0;
      const double scale = trial > 0 ? tau / trial : 0;
      const double carried = viscous_share(c_ratio[i]).carried;
      // (trial - tau)/(G dt) has yielded. In tension the viscosity stays: it is all that keeps a
      // cohesive mass from tearing at every spacing.
      const double eta = e1 < held ? 0 : viscous;
      c_ratio[i] = eta * (trial - tau) / (tau + 1e-6);  // finite without load
      s_xx[i] = scale * t.xx - p1, s_yy[i] = scale * t.yy - p1;
      s_zz[i] = scale * t.zz - p1, s_xy[i] = scale * t.xy;
      s_yz[i] = scale * t.yz, s_zx[i] = scale * t.zx;

      const double volume = mass[i] * inv_density, mean_p = 0.5 * (p0 + p1);
      // By the stresses at both ends of the step: what the trial overshoots never acts.
      const double work = 0.5 * (s.dot(d) + scale * t.dot(d));
      const double replaced = carried * dt * work;  // the viscosity takes it instead
      const double squeezed = p1 - q1;
      elastic += volume * (squeezed * squeezed * half_inv_bulk + tau * tau * half_inv_shear);
      if constexpr (Packing::dilates) frictional += volume * 0.5 * (q0 + q1) * (e1 - e0);
      // As the law stores it: per reference volume.
      power += volume * (dt * work - replaced + mean_p * squeezed_by);
      plastic += volume * (dt * work - replaced - (tau * tau - s.norm2()) * half_inv_shear);
      diffusion += volume * (mean_p * diffused + smoothed * half_inv_shear);
    }
    out += StressEnergies{elastic, frictional, power, plastic, diffusion, resting};
  }

  MuIRheology law_;
  bool smooth_;
  double floor_, inv_rest_speed2_, rest_drag_;
  double bulk_, shear_, half_inv_bulk_, half_inv_shear_, inv_density_, dt_;
  double viscous_;  ///< eta/(G dt) of the artificial viscosity
  float touching_;
  double slowness_;
};

}  // namespace sturz
