// SPDX-License-Identifier: Apache-2.0
/// Density and stress of one dense particle from n to n+1 (physics.md B.5), with its energies.
#pragma once

#include <cmath>

#include "engine/effects/fused_sweep.hpp"
#include "engine/effects/terms/grain_stress_settings.hpp"

namespace sturz {

/// Elastic energy [J] of a reference volume: V_0 (p^2/2K + tau^2/2G), p = K max(0, compression).
inline double elastic_energy(const GrainStressSettings& g, double volume, double compression,
                             double shear_stress) {
  const double p = g.bulk_modulus() * std::fmax(0.0, compression);
  return volume * (p * p / (2 * g.bulk_modulus()) +
                   shear_stress * shear_stress / (2 * g.shear_modulus()));
}

/// Raw pointers to the columns that the update reads and writes.
struct StressColumns {
  const double* mass = nullptr;
  double *vx = nullptr, *vy = nullptr, *vz = nullptr;
  double* compression = nullptr;
  double* stress[6] = {};   ///< xx yy zz xy yz zx [Pa], tension positive
};

/// Sums over particles [J].
struct StressEnergies {
  double elastic = 0;    ///< stored after the step
  double power = 0;      ///< V sigma : D dt
  double plastic = 0;    ///< dissipated by the return
  double diffusion = 0;  ///< added by density diffusion and stress smoothing
  double rest = 0;       ///< taken by the drag at rest

  StressEnergies& operator+=(const StressEnergies& o) {
    elastic += o.elastic;
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
        slowness_(shear_ * dt * g.law.inertial_number_scale /
                  (g.law.grain_diameter * std::sqrt(g.law.grain_density))) {}

  /// Particles [begin, end). One branch-free body per particle, so that the compiler puts four of
  /// them side by side.
  void apply(const StressColumns& c, const SweepOutput& rate, std::size_t begin, std::size_t end,
             StressEnergies& out) const {
    if (smooth_)
      range<true>(c, rate, begin, end, out);
    else
      range<false>(c, rate, begin, end, out);
  }

 private:
  /// A symmetric tensor in registers.
  struct Symmetric {
    double xx, yy, zz, xy, yz, zx;
    /// Half its double contraction: tau^2 of a deviator.
    double norm2() const {
      return 0.5 * (xx * xx + yy * yy + zz * zz) + xy * xy + yz * yz + zx * zx;
    }
    double dot(const Symmetric& o) const {
      return xx * o.xx + yy * o.yy + zz * o.zz + 2 * (xy * o.xy + yz * o.yz + zx * o.zx);
    }
    /// this + f o
    Symmetric plus(double f, const Symmetric& o) const {
      return {xx + f * o.xx, yy + f * o.yy, zz + f * o.zz,
              xy + f * o.xy, yz + f * o.yz, zx + f * o.zx};
    }
  };

  template <bool smooth>
  void range(const StressColumns& c, const SweepOutput& r, std::size_t begin, std::size_t end,
             StressEnergies& out) const {
    double elastic = 0, power = 0, plastic = 0, diffusion = 0, resting = 0;
    // Pointers in locals: the vectoriser does not look through the structs.
    const float *r_lxx = r.lxx, *r_lxy = r.lxy, *r_lxz = r.lxz;
    const float *r_lyx = r.lyx, *r_lyy = r.lyy, *r_lyz = r.lyz;
    const float *r_lzx = r.lzx, *r_lzy = r.lzy, *r_lzz = r.lzz, *r_diffusion = r.diffusion;
    const float *r_xx = r.smooth[0], *r_yy = r.smooth[1], *r_zz = r.smooth[2];
    const float *r_xy = r.smooth[3], *r_yz = r.smooth[4], *r_zx = r.smooth[5];
    const double* mass = c.mass;
    double *compression = c.compression, *c_vx = c.vx, *c_vy = c.vy, *c_vz = c.vz;
    double *s_xx = c.stress[0], *s_yy = c.stress[1], *s_zz = c.stress[2];
    double *s_xy = c.stress[3], *s_yz = c.stress[4], *s_zx = c.stress[5];
    const MuIRheology law = law_;
    const double dt = dt_, bulk = bulk_, shear = shear_, slowness = slowness_, floor = floor_;
    const double inv_rest_speed2 = inv_rest_speed2_, rest_drag = rest_drag_;
    const double half_inv_bulk = half_inv_bulk_, half_inv_shear = half_inv_shear_;
    const double inv_density = inv_density_;
#pragma omp simd reduction(+ : elastic, power, plastic, diffusion, resting)
    for (std::size_t i = begin; i < end; ++i) {
      const double lxx = r_lxx[i], lxy = r_lxy[i], lxz = r_lxz[i];
      const double lyx = r_lyx[i], lyy = r_lyy[i], lyz = r_lyz[i];
      const double lzx = r_lzx[i], lzy = r_lzy[i], lzz = r_lzz[i];
      const double trace = lxx + lyy + lzz;

      // Density on the continuity equation, cut at zero pressure in tension.
      const double e0 = compression[i];
      const double diffused = dt * r_diffusion[i];
      const double moved = e0 - dt * (1 + e0) * trace + diffused;
      const double e1 = moved > least_compression ? moved : least_compression;
      const double p0 = e0 > 0 ? bulk * e0 : 0, p1 = e1 > 0 ? bulk * e1 : 0;
      compression[i] = e1;

      // Drag on loaded grains that hardly move: 0 at rest .. 1 in motion.
      const double vx = c_vx[i], vy = c_vy[i], vz = c_vz[i];
      const double v2 = vx * vx + vy * vy + vz * vz, relative2 = v2 * inv_rest_speed2;
      const double motion = relative2 < 1 ? relative2 : 1;
      const double keep = p1 > 0 ? 1 - (1 - motion) * rest_drag : 1;
      c_vx[i] = keep * vx, c_vy[i] = keep * vy, c_vz[i] = keep * vz;
      resting += 0.5 * mass[i] * v2 * (1 - keep * keep);

      Symmetric s{s_xx[i] + p0, s_yy[i] + p0, s_zz[i] + p0,
                  s_xy[i],      s_yz[i],      s_zx[i]};
      double smoothed = 0;
      if constexpr (smooth) {
        const double before = s.norm2(), weight = p0 > 0 ? dt * (p0 + floor) * motion : 0;
        s = s.plus(weight, {r_xx[i], r_yy[i], r_zz[i], r_xy[i],
                            r_yz[i], r_zx[i]});
        smoothed = s.norm2() - before;
      }
      s = rotated(s, 0.25 * dt * (lzy - lyz), 0.25 * dt * (lxz - lzx),
                  0.25 * dt * (lyx - lxy));

      // Elastic trial, then the closed-form return to the yield surface.
      const double third = trace / 3;
      const Symmetric d{lxx - third,       lyy - third,       lzz - third,
                        0.5 * (lxy + lyx), 0.5 * (lyz + lzy), 0.5 * (lzx + lxz)};
      const Symmetric t = s.plus(2 * shear * dt, d);
      const double trial2 = t.norm2(), trial = std::sqrt(trial2);
      const double kept = yield_return(law, trial, p1, slowness);
      const double tau = e1 < separation ? 0 : kept;  // parted grains carry no shear
      const double scale = trial > 0 ? tau / trial : 0;
      s_xx[i] = scale * t.xx - p1, s_yy[i] = scale * t.yy - p1;
      s_zz[i] = scale * t.zz - p1, s_xy[i] = scale * t.xy;
      s_yz[i] = scale * t.yz, s_zx[i] = scale * t.zx;

      const double volume = mass[i] * inv_density, mean_p = 0.5 * (p0 + p1);
      const double work = 0.5 * (s.dot(d) + t.dot(d));
      elastic += volume * (p1 * p1 * half_inv_bulk + tau * tau * half_inv_shear);
      power += volume * dt * (work - mean_p * trace);
      plastic += volume * (trial2 - tau * tau) * half_inv_shear;
      diffusion += volume * (mean_p * diffused + smoothed * half_inv_shear);
    }
    out += StressEnergies{elastic, power, plastic, diffusion, resting};
  }

  /// How much dilation is remembered: the sums of few far neighbours drift, and a grain that
  /// must first lose a drifted 90 % of its volume would carry nothing when it is buried again.
  static constexpr double least_compression = -0.2;
  static constexpr double separation = GrainStressSettings::separation;

  /// s <- Q s Q^T with Q = I + 2/(1+a.a) ([a]x + [a]x^2), the Cayley form of the spin: exactly
  /// orthogonal, so tau is untouched by rigid rotation. a = half the rotation vector of the step.
  static Symmetric rotated(const Symmetric& s, double ax, double ay, double az) {
    const double f = 2 / (1 + ax * ax + ay * ay + az * az);
    const double q00 = 1 - f * (ay * ay + az * az), q01 = f * (ax * ay - az),
                 q02 = f * (ax * az + ay);
    const double q10 = f * (ax * ay + az), q11 = 1 - f * (ax * ax + az * az),
                 q12 = f * (ay * az - ax);
    const double q20 = f * (ax * az - ay), q21 = f * (ay * az + ax),
                 q22 = 1 - f * (ax * ax + ay * ay);
    const double a00 = q00 * s.xx + q01 * s.xy + q02 * s.zx;
    const double a01 = q00 * s.xy + q01 * s.yy + q02 * s.yz;
    const double a02 = q00 * s.zx + q01 * s.yz + q02 * s.zz;
    const double a10 = q10 * s.xx + q11 * s.xy + q12 * s.zx;
    const double a11 = q10 * s.xy + q11 * s.yy + q12 * s.yz;
    const double a12 = q10 * s.zx + q11 * s.yz + q12 * s.zz;
    const double a20 = q20 * s.xx + q21 * s.xy + q22 * s.zx;
    const double a21 = q20 * s.xy + q21 * s.yy + q22 * s.yz;
    const double a22 = q20 * s.zx + q21 * s.yz + q22 * s.zz;
    return {a00 * q00 + a01 * q01 + a02 * q02, a10 * q10 + a11 * q11 + a12 * q12,
            a20 * q20 + a21 * q21 + a22 * q22, a00 * q10 + a01 * q11 + a02 * q12,
            a10 * q20 + a11 * q21 + a12 * q22, a20 * q00 + a21 * q01 + a22 * q02};
  }

  MuIRheology law_;
  bool smooth_;
  double floor_, inv_rest_speed2_, rest_drag_;
  double bulk_, shear_, half_inv_bulk_, half_inv_shear_, inv_density_, dt_, slowness_;
};

}  // namespace sturz
