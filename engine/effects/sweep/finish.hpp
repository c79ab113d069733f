// SPDX-License-Identifier: Apache-2.0
/// What follows from a group's sums: acceleration, gradients, rates.
#pragma once

#include "engine/effects/kinetic/sums.hpp"
#include "engine/effects/sweep/group_rows.hpp"
#include "engine/effects/sweep/image_sums.hpp"

namespace sturz::STURZ_ISA {

/// M : nn / 0.25, between 0 and 1, with nn from the walls' own moment.
inline Lanes mirror_weight(const DenseSums& s, const Lanes w[6], Lanes scale) {
  const Lanes trace = w[0] + w[1] + w[2];
  const Lanes along = fma(s.mxx, w[0], fma(s.myy, w[1], s.mzz * w[2])) +
                      Lanes::all(2) * fma(s.mxy, w[3], fma(s.myz, w[4], s.mzx * w[5]));
  const Lanes share = Lanes::all(4) * scale * along / max(trace, Lanes::all(1e-6f));
  const Lanes one = Lanes::all(1);
  return select_less(share, one, max(share, Lanes::all(0)), one);
}

/// What analytic walls add to the moment matrix and, before correction, to the velocity gradient:
/// 2 W_plane(d) d n n and 2 W_plane(d) v_n n n (SmoothingKernel::plane_integral) with the weight of
/// the mirror contribution, which is written; xx yy zz xy yz zx.
struct WallContribution {
  Lanes moment[6], gradient[6];

  WallContribution(const DenseSums& s, const BoundaryView& wall, Lanes scale,
                   const SweepOutput& out, std::size_t at) {
    for (int c = 0; c < 6; ++c) moment[c] = gradient[c] = Lanes::all(0);
    if (!wall.moment[0]) return;
    for (int c = 0; c < 6; ++c) moment[c] = Lanes::load(wall.moment[c] + at);
    const Lanes share = mirror_weight(s, moment, scale);
    share.store(out.mirror_weight + at);
    for (int c = 0; c < 6; ++c) {
      moment[c] = share * moment[c];
      gradient[c] = share * Lanes::load(wall.gradient[c] + at);
    }
  }
};

/// Density diffusion and the gradient of the density for the next step. Density is not mirrored (it
/// goes on rising towards the bed): its gradient is taken from the neighbours alone.
inline void finish_density(const DenseSums& s, const DenseScale& k, const HalfDensityGradient* half,
                           const SweepOutput& out, std::size_t at) {
  Lanes none[6];
  for (Lanes& c : none) c = Lanes::all(0);
  const Correction own(s, Lanes::all(k.moment), none);
  const Lanes back = Lanes::all(-k.gradient);
  (back * fma(own.xx, s.nx, fma(own.xy, s.ny, own.zx * s.nz))).store(out.density_gradient[0] + at);
  (back * fma(own.xy, s.nx, fma(own.yy, s.ny, own.yz * s.nz))).store(out.density_gradient[1] + at);
  (back * fma(own.zx, s.nx, fma(own.yz, s.ny, own.zz * s.nz))).store(out.density_gradient[2] + at);
  alignas(64) float x[Lanes::width], y[Lanes::width], z[Lanes::width];
  for (int n = 0; n < Lanes::width; ++n) x[n] = half[n].x, y[n] = half[n].y, z[n] = half[n].z;
  const Lanes linear = fma(Lanes::load(x), s.gx, fma(Lanes::load(y), s.gy, Lanes::load(z) * s.gz));
  (Lanes::all(k.diffusion) * (s.d + linear)).store(out.diffusion + at);
}

/// The part of the images' push along the ground joins the pairs' acceleration: walls and contacts
/// of the same step see it.
inline void push_along_ground(const BoundaryView& wall, const SweepOutput& out, std::size_t at) {
  const Lanes n[3] = {Lanes::load(wall.nx + at), Lanes::load(wall.ny + at),
                      Lanes::load(wall.nz + at)};
  Lanes push[3];
  for (int k = 0; k < 3; ++k) push[k] = Lanes::load(out.from_ground[k] + at);
  const Lanes normal = fma(n[0], push[0], fma(n[1], push[1], n[2] * push[2]));
  float* const acceleration[3] = {out.ax + at, out.ay + at, out.az + at};
  for (int k = 0; k < 3; ++k)
    (Lanes::load(acceleration[k]) + fnma(normal, n[k], push[k])).store(acceleration[k]);
}

/// Turns sums into acceleration, corrected velocity gradient and diffusion rate.
/// \param s        the images in the ground are added to its gradient and moment
/// \param images   null: no grain of the group is near the ground
/// \param dilation_ratio  true volume over that of the records, 1 in a dense mass: sums over
///                neighbours that dilated alike are too small by it
/// \tparam dispersed  whether the group may be a cloud
/// \return trace of the moment that walls add
template <bool dispersed>
inline Lanes finish_dense(DenseSums& s, const ImageSums* images, const GroupRows& rows, int lane,
                          const DenseScale& k, const NeighborView& view, const BoundaryView& wall,
                          const SweepOutput& out, std::size_t at, Lanes dilation_ratio) {
  const Lanes sxx = Lanes::load(rows.sxx + lane), syy = Lanes::load(rows.syy + lane);
  const Lanes szz = Lanes::load(rows.szz + lane), sxy = Lanes::load(rows.sxy + lane);
  const Lanes syz = Lanes::load(rows.syz + lane), szx = Lanes::load(rows.szx + lane);
  const Lanes one = Lanes::all(1);
  const Lanes density = Lanes::all(k.density) * (one + Lanes::load(rows.density_change + lane));
  const Lanes factor = Lanes::all(-k.gradient) / density;
  auto push = [&](const auto& sum, float* ox, float* oy, float* oz) {
    (factor * fma(sxx, sum.gx, fma(sxy, sum.gy, fma(szx, sum.gz, sum.ax)))).store(ox + at);
    (factor * fma(sxy, sum.gx, fma(syy, sum.gy, fma(syz, sum.gz, sum.ay)))).store(oy + at);
    (factor * fma(szx, sum.gx, fma(syz, sum.gy, fma(szz, sum.gz, sum.az)))).store(oz + at);
  };
  push(s, out.ax, out.ay, out.az);
  finish_density(s, k, view.density_gradient + at, out, at);

  const Lanes moment = Lanes::all(k.moment) * dilation_ratio;
  if (images) {
    push(*images, out.from_ground[0], out.from_ground[1], out.from_ground[2]);
    push_along_ground(wall, out, at);
    ground_weight(s, moment, wall, at).store(out.ground_weight + at);
    images->add_to(s);
  } else {
    one.store(out.ground_weight + at);
  }
  const WallContribution walls(s, wall, moment, out, at);
  const Correction b = dispersed ? Correction::in_a_cloud(s, moment, walls.moment, dilation_ratio)
                                 : Correction(s, moment, walls.moment);
  const Lanes scale = Lanes::all(k.gradient) * dilation_ratio;
  auto row = [&](Lanes x, Lanes y, Lanes z, float* ox, float* oy, float* oz) {
    fma(x, b.xx, fma(y, b.xy, z * b.zx)).store(ox + at);
    fma(x, b.xy, fma(y, b.yy, z * b.yz)).store(oy + at);
    fma(x, b.zx, fma(y, b.yz, z * b.zz)).store(oz + at);
  };
  const Lanes* w = walls.gradient;
  row(fma(scale, s.lxx, w[0]), fma(scale, s.lxy, w[3]), fma(scale, s.lxz, w[5]), out.lxx, out.lxy,
      out.lxz);
  row(fma(scale, s.lyx, w[3]), fma(scale, s.lyy, w[1]), fma(scale, s.lyz, w[4]), out.lyx, out.lyy,
      out.lyz);
  row(fma(scale, s.lzx, w[5]), fma(scale, s.lzy, w[4]), fma(scale, s.lzz, w[2]), out.lzx, out.lzy,
      out.lzz);
  return walls.moment[0] + walls.moment[1] + walls.moment[2];
}

/// A third of the moment's trace: 1 inside a dense mass, about a half at its surface.
/// \param s  with the images in the ground; \param mirror_trace  of walls
inline Lanes support_completeness(const DenseSums& s, const DenseScale& k, Lanes mirror_trace) {
  const Lanes trace = Lanes::all(k.moment) * (s.mxx + s.myy + s.mzz);
  return Lanes::all(1.0f / 3) * (trace + mirror_trace);
}

/// What the artificial stress adds to the acceleration.
inline void finish_tension(const TensionSums& s, const GroupRows& rows, int lane,
                           const DenseScale& k, const SweepOutput& out, std::size_t at) {
  const Lanes density =
      Lanes::all(k.density) * (Lanes::all(1) + Lanes::load(rows.density_change + lane));
  const Lanes factor = Lanes::all(k.gradient) / density, own = Lanes::load(rows.tension + lane);
  auto push = [&](float* a, Lanes force) { fma(factor, force, Lanes::load(a)).store(a); };
  push(out.ax + at, fma(own, s.cx, s.bx));
  push(out.ay + at, fma(own, s.cy, s.by));
  push(out.az + at, fma(own, s.cz, s.bz));
}

/// What kinetic stresses add to the acceleration, conducted granular energy, and how complete the
/// support is.
inline void finish_kinetic(const KineticSums& s, const DenseSums& dense, const GroupRows& rows,
                           const KineticRows& own, int lane, const DenseScale& k,
                           Lanes mirror_trace, const SweepOutput& out, std::size_t at) {
  const Lanes dilation_ratio = Lanes::load(own.dilation_ratio + lane),
              weight = Lanes::load(own.weight + lane);
  const Lanes density =
      Lanes::all(k.density) * (Lanes::all(1) + Lanes::load(rows.density_change + lane));
  const Lanes factor = Lanes::all(-k.gradient) * weight / density;
  const Lanes xx = Lanes::load(own.xx + lane), yy = Lanes::load(own.yy + lane);
  const Lanes zz = Lanes::load(own.zz + lane), xy = Lanes::load(own.xy + lane);
  const Lanes yz = Lanes::load(own.yz + lane), zx = Lanes::load(own.zx + lane);
  auto push = [&](float* a, Lanes force) { fma(factor, force, Lanes::load(a)).store(a); };
  push(out.ax + at, fma(xx, s.gx, fma(xy, s.gy, fma(zx, s.gz, s.kx))));
  push(out.ay + at, fma(xy, s.gx, fma(yy, s.gy, fma(yz, s.gz, s.ky))));
  push(out.az + at, fma(zx, s.gx, fma(yz, s.gy, fma(zz, s.gz, s.kz))));
  // Per volume that the grain takes up: the record's times `dilation_ratio`.
  const Lanes share = weight / dilation_ratio, half = Lanes::all(0.5f);
  (Lanes::all(k.laplacian) * share * s.conducted).store(out.conducted + at);
  const Lanes pair_gradient = Lanes::all(k.gradient) * share;
  (pair_gradient * s.exx).store(out.pair_gradient[0] + at),
      (pair_gradient * s.eyy).store(out.pair_gradient[1] + at);
  (pair_gradient * s.ezz).store(out.pair_gradient[2] + at),
      (half * pair_gradient * s.exy).store(out.pair_gradient[3] + at);
  (half * pair_gradient * s.eyz).store(out.pair_gradient[4] + at),
      (half * pair_gradient * s.ezx).store(out.pair_gradient[5] + at);
  support_completeness(dense, k, mirror_trace / dilation_ratio)
      .store(out.support_completeness + at);
  s.count.store(out.neighbors + at);
}

/// Deviator of the smoothed ratio's rate: zeta' (Sum w S_j - S_i Sum w).
inline void finish_ratio(const RatioSums& r, const GroupRows& rows, int lane, const DenseScale& k,
                         const SweepOutput& out, std::size_t at) {
  const Lanes third = Lanes::all(RatioSums::third), scale = Lanes::all(k.smoothing);
  const Lanes trace =
      Lanes::load(rows.sxx + lane) + Lanes::load(rows.syy + lane) + Lanes::load(rows.szz + lane);
  const Lanes v = r.weight * (Lanes::all(1) / (Lanes::all(k.ratio_floor) - third * trace));
  const Lanes xx = fnma(v, Lanes::load(rows.sxx + lane), r.xx);
  const Lanes yy = fnma(v, Lanes::load(rows.syy + lane), r.yy);
  const Lanes zz = fnma(v, Lanes::load(rows.szz + lane), r.zz);
  const Lanes mean = third * (xx + yy + zz);
  (scale * (xx - mean)).store(out.smooth[0] + at);
  (scale * (yy - mean)).store(out.smooth[1] + at);
  (scale * (zz - mean)).store(out.smooth[2] + at);
  (scale * fnma(v, Lanes::load(rows.sxy + lane), r.xy)).store(out.smooth[3] + at);
  (scale * fnma(v, Lanes::load(rows.syz + lane), r.yz)).store(out.smooth[4] + at);
  (scale * fnma(v, Lanes::load(rows.szx + lane), r.zx)).store(out.smooth[5] + at);
}

}  // namespace sturz::STURZ_ISA
