// SPDX-License-Identifier: Apache-2.0
/// What a dense grain gathers from its neighbours in one loop, and what follows from the sums.
///
/// With t = max(0, 1 - r/2h): grad_i W_ij = -C t^3 r_ij, so d = V_j t^3 r_ij serves every sum:
///   velocity gradient  L += (v_i - v_j) (x) d          B.3, corrected by B = M^-1 after the loop
///   moment matrix      M += r_ij (x) d                 B.3
///   momentum           A += sigma_j d, G += d          B.4, a = -(C/rho)(A + sigma_i G)
///   viscosity          A += k (f_i + f_j)/2 q d, q = v_ij.r_ij/(r^2 + 0.01 h^2)   B.4, bilateral,
///                      in the shares f that act (dense/viscous_share.hpp)
///   density diffusion  D += V_j t^3 (e_j - e_i + (g_j.r_ij)/2), then + (g_i.G)/2   B.2: the
///                      linear part of the density field is taken out by the mean of both grains'
///                      gradients g (of the step before), so that a hydrostatic column or a sheet
///                      on a slope does not diffuse and a pair gives and takes the same
///   its gradient       N += (e_j - e_i) d, g = -M^-1 N for the next step
#pragma once

#include "engine/core/lanes.hpp"
#include "engine/neighbors/neighbor_records.hpp"

namespace sturz::STURZ_ISA {

/// Constants in the units of the loop: positions in fixed-point units.
struct DenseScale {
  float to_s;           ///< position units -> r/2h
  float eta2;           ///< 0.01 h^2 in units^2
  float viscosity;      ///< k: alpha_v c0 h rho_ref / unit
  float gradient;       ///< C unit: sums of u (x) d -> 1/s
  float moment;         ///< C unit^2
  float diffusion;      ///< 2 delta h c0 C
  float density;        ///< rho_ref
  float smoothing;      ///< 2 zeta h c0 C
  float ratio_floor;    ///< p_c of the smoothed ratio [Pa]
  float laplacian;      ///< C unit-free: sums of V t^3 (f_j - f_i) -> half the Laplacian
  float inv_w_spacing;  ///< 1/(t^4 (5 - 4t)) one spacing away
  float support;        ///< 2h in units
};

inline DenseScale dense_scale(const SweepConstants& c, double unit) {
  DenseScale s;
  s.to_s = static_cast<float>(unit / (2 * c.h));
  s.eta2 = static_cast<float>(0.01 * c.h * c.h / (unit * unit));
  s.viscosity = static_cast<float>(c.viscosity * c.sound_speed * c.h * c.reference_density / unit);
  s.gradient = static_cast<float>(c.gradient_factor * unit);
  s.moment = static_cast<float>(c.gradient_factor * unit * unit);
  s.diffusion =
      static_cast<float>(2 * c.density_diffusion * c.h * c.sound_speed * c.gradient_factor);
  s.density = static_cast<float>(c.reference_density);
  s.smoothing =
      static_cast<float>(2 * c.stress_smoothing * c.h * c.sound_speed * c.gradient_factor);
  s.ratio_floor = static_cast<float>(c.ratio_floor);
  s.laplacian = static_cast<float>(c.gradient_factor);
  const double t = 1 - c.spacing / (2 * c.h);
  s.inv_w_spacing = static_cast<float>(1 / (t * t * t * t * (5 - 4 * t)));
  s.support = static_cast<float>(2 * c.h / unit);
  return s;
}

/// The lanes' own values.
struct DenseSelf {
  IntLanes x, y, z;
  Lanes vx, vy, vz, density_change;
};

/// Sums for the smoothing of the stress ratio S = s/(p + p_c): Sum V_j t^3 sigma_j/(p_j + p_c).
/// The ratio, not the stress, is smoothed because it is uniform in a geostatic column and in a
/// sheet on a slope, up to the bed and the free surface.
struct RatioSums {
  static constexpr float third = 1.0f / 3;
  Lanes xx, yy, zz, xy, yz, zx, weight;

  void clear() { xx = yy = zz = xy = yz = zx = weight = Lanes::all(0); }
  void add(const NeighborRecord& j, const DenseScale& k, Lanes w) {
    // In the order of finish_ratio, or a uniform ratio would not cancel to the last bit.
    const Lanes v = w * Lanes::all(1 / (k.ratio_floor - third * (j.sxx + j.syy + j.szz)));
    xx = fma(v, Lanes::all(j.sxx), xx), yy = fma(v, Lanes::all(j.syy), yy);
    zz = fma(v, Lanes::all(j.szz), zz), xy = fma(v, Lanes::all(j.sxy), xy);
    yz = fma(v, Lanes::all(j.syz), yz), zx = fma(v, Lanes::all(j.szx), zx);
    weight = weight + w;
  }
};

struct DenseSums {
  Lanes lxx, lxy, lxz, lyx, lyy, lyz, lzx, lzy, lzz;
  Lanes mxx, myy, mzz, mxy, myz, mzx;
  Lanes gx, gy, gz;
  Lanes ax, ay, az;
  Lanes nx, ny, nz, d;

  void clear() {
    const Lanes o = Lanes::all(0);
    lxx = lxy = lxz = lyx = lyy = lyz = lzx = lzy = lzz = o;
    mxx = myy = mzz = mxy = myz = mzx = o;
    gx = gy = gz = ax = ay = az = nx = ny = nz = d = o;
  }

  /// Adds one neighbour to all lanes. A particle outside the support or the lane itself adds zero.
  /// \param half_gradient  of the neighbour's density
  /// \param viscosity  DenseScale::viscosity in the share that acts between the pair
  /// \return the weight V_j t^3
  Lanes add(const DenseSelf& i, const NeighborRecord& j, const HalfDensityGradient& half_gradient,
            const DenseScale& k, Lanes viscosity) {
    const Lanes rx = difference(i.x, j.x), ry = difference(i.y, j.y), rz = difference(i.z, j.z);
    const Lanes r2 = fma(rx, rx, fma(ry, ry, rz * rz));
    const Lanes t = max(Lanes::all(0), fnma(sqrt(r2), Lanes::all(k.to_s), Lanes::all(1)));
    const Lanes w = t * t * t * Lanes::all(j.volume);
    const Lanes dx = w * rx, dy = w * ry, dz = w * rz;
    const Lanes ux = i.vx - Lanes::all(j.vx);
    const Lanes uy = i.vy - Lanes::all(j.vy);
    const Lanes uz = i.vz - Lanes::all(j.vz);

    lxx = fma(ux, dx, lxx), lxy = fma(ux, dy, lxy), lxz = fma(ux, dz, lxz);
    lyx = fma(uy, dx, lyx), lyy = fma(uy, dy, lyy), lyz = fma(uy, dz, lyz);
    lzx = fma(uz, dx, lzx), lzy = fma(uz, dy, lzy), lzz = fma(uz, dz, lzz);
    mxx = fma(rx, dx, mxx), myy = fma(ry, dy, myy), mzz = fma(rz, dz, mzz);
    mxy = fma(rx, dy, mxy), myz = fma(ry, dz, myz), mzx = fma(rz, dx, mzx);
    gx = gx + dx, gy = gy + dy, gz = gz + dz;

    const Lanes ur = fma(ux, rx, fma(uy, ry, uz * rz));
    const Lanes q = ur * viscosity / (r2 + Lanes::all(k.eta2));
    const Lanes sxy = Lanes::all(j.sxy), syz = Lanes::all(j.syz), szx = Lanes::all(j.szx);
    ax = fma(Lanes::all(j.sxx) + q, dx, fma(sxy, dy, fma(szx, dz, ax)));
    ay = fma(sxy, dx, fma(Lanes::all(j.syy) + q, dy, fma(syz, dz, ay)));
    az = fma(szx, dx, fma(syz, dy, fma(Lanes::all(j.szz) + q, dz, az)));

    const Lanes e = Lanes::all(j.density_change) - i.density_change;
    const Lanes gx_j = Lanes::all(half_gradient.x), gy_j = Lanes::all(half_gradient.y);
    const Lanes linear = fma(gx_j, rx, fma(gy_j, ry, Lanes::all(half_gradient.z) * rz));
    d = fma(w, e + linear, d);
    nx = fma(e, dx, nx), ny = fma(e, dy, ny), nz = fma(e, dz, nz);
    return w;
  }
};

/// The inverse of a symmetric 3 x 3 matrix, or the identity where the matrix is too poor:
/// det M < 0.15 or |B| > 5 (B.3's fallback).
struct Correction {
  Lanes xx, yy, zz, xy, yz, zx;

  /// \param wall  what walls add to the moment matrix, xx yy zz xy yz zx
  Correction(const DenseSums& s, Lanes scale, const Lanes wall[6])
      : Correction(fma(s.mxx, scale, wall[0]), fma(s.myy, scale, wall[1]),
                   fma(s.mzz, scale, wall[2]), fma(s.mxy, scale, wall[3]),
                   fma(s.myz, scale, wall[4]), fma(s.mzx, scale, wall[5])) {}

  /// In a cloud the few neighbours carry more or less than their share, whatever their directions:
  /// there M is judged, and where it is poor replaced, in units of its mean diagonal. Not so at the
  /// surface of a dense mass, where pair forces lack the same share that M does: a full gradient
  /// there would make the stress dissipate what no force takes.
  /// \param dilation_ratio  of the grain, 1: dense
  static Correction in_a_cloud(const DenseSums& s, Lanes scale, const Lanes wall[6],
                               Lanes dilation_ratio) {
    const Lanes xx = fma(s.mxx, scale, wall[0]), yy = fma(s.myy, scale, wall[1]);
    const Lanes zz = fma(s.mzz, scale, wall[2]), one = Lanes::all(1);
    const Lanes least = max(one / (dilation_ratio * dilation_ratio), Lanes::all(0.5f));
    const Lanes diagonal = max(Lanes::all(1.0f / 3) * (xx + yy + zz), least);
    const Lanes u = one / select_less(diagonal, one, diagonal, one);
    Correction c(u * xx, u * yy, u * zz, u * fma(s.mxy, scale, wall[3]),
                 u * fma(s.myz, scale, wall[4]), u * fma(s.mzx, scale, wall[5]));
    c.xx = u * c.xx, c.yy = u * c.yy, c.zz = u * c.zz;
    c.xy = u * c.xy, c.yz = u * c.yz, c.zx = u * c.zx;
    return c;
  }

 private:
  Correction(Lanes mxx, Lanes myy, Lanes mzz, Lanes mxy, Lanes myz, Lanes mzx) {
    const Lanes cxx = fnma(myz, myz, myy * mzz);
    const Lanes cxy = fnma(mxy, mzz, myz * mzx);
    const Lanes czx = fnma(myy, mzx, mxy * myz);
    const Lanes det = fma(mxx, cxx, fma(mxy, cxy, mzx * czx));
    const Lanes one = Lanes::all(1), zero = Lanes::all(0), least = Lanes::all(0.15f);
    const Lanes inv = one / max(det, least);
    xx = cxx * inv, xy = cxy * inv, zx = czx * inv;
    yy = fnma(mzx, mzx, mxx * mzz) * inv;
    yz = fnma(mxx, myz, mxy * mzx) * inv;
    zz = fnma(mxy, mxy, mxx * myy) * inv;
    const Lanes norm2 =
        fma(xx, xx, fma(yy, yy, zz * zz)) + Lanes::all(2) * fma(xy, xy, fma(yz, yz, zx * zx));
    const Lanes limit = Lanes::all(25);
    const Lanes poor =
        max(select_less(det, least, one, zero), select_less(limit, norm2, one, zero));
    auto pick = [&](Lanes good, Lanes identity) { return select_less(zero, poor, identity, good); };
    xx = pick(xx, one), yy = pick(yy, one), zz = pick(zz, one);
    xy = pick(xy, zero), yz = pick(yz, zero), zx = pick(zx, zero);
  }
};

}  // namespace sturz::STURZ_ISA
