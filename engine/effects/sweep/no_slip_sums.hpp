// SPDX-License-Identifier: Apache-2.0
/// The neighbours of a liquid particle mirrored in a bed that holds it (docs/physics.md B.10).
///
/// The image j' of a neighbour lies where a bed that slips has it (image_sums.hpp), at
/// r' = r_ij + 2 d_j n. In parts along the bed and normal to it, r' = r_t + r'_n n with
/// r'_n = d_i + d_j; r_t is that of the neighbour itself. A flow u(z) that the wall holds is odd in
/// z, its shear stress therefore even, and pressure is even as it is in any mirror:
///   stress             sigma' = sigma_j: R sigma_j R of the slipping bed with its shear reversed
///   momentum           Sum (sigma_i + sigma_j) d'                  d' = V_j t^3 r'
/// Its power Sum V_i v_i.(sigma_i + sigma_j) d', gathered by the stress of one particle (the pair
/// seen from j has r_t reversed and r'_n the same), is that of the velocity gradient
///   velocity gradient  Sum (v_i + v_j) (x) V_j t^3 r'_n n  +  Sum (v_i - v_j) (x) V_j t^3 r_t
/// Along the normal the image moves with -v_j. Along the bed it moves with v_j: a liquid that
/// spreads over the bed does so in its first layer as well, and reversed wholly (tried) the image
/// would hide half of that spread beside the bed from the density, but not the sinking that comes
/// with it.
///   moment matrix      Sum V_j t^3 (r_ij (x) r_ij + 4 d_i d_j n (x) n)
/// for which every v = a (n.r), the flow that a wall at rest bounds, has its exact gradient up to
/// the wall in any disorder, and M is symmetric.
///
/// On a plane the parts along the bed of sigma_tt are opposite in a pair; those of sigma_tn are the
/// same on both, and are the traction of the bed.
///
/// Artificial viscosity, with S = (v_i + v_j).r_t, T = (v_i - v_j).r_t, N = (v_i + v_j).n r'_n:
///   for noise   (k - k_h) (T + N)/(r'^2 + 0.01 h^2) d': the bed slips, or its friction would be
///   that of
///               the numerical viscosity and not of the liquid
///   held        k_h V_j t^3 (S r_t + N r'_n n)/(r'^2 + 0.01 h^2): the share of it that stands for
///   the
///               liquid's own viscosity. Without it the bed's traction would lack that share. It is
///               also what damps the velocity that alternates from layer to layer, which gradients
///               over two spacings do not see and a wall excites: by stress alone a film of 20
///               layers is 6 % off in steady flow, with a tenth of its viscosity by pairs 0.3 %.
/// Both take energy from every pair: (T + N)^2, and S^2 + N^2.
#pragma once

#include "engine/effects/sweep/image_sums.hpp"

namespace sturz::STURZ_ISA {

/// Sums over the images, in the frame of the particles.
class NoSlipSums {
 public:
  NoSlipSums(const DenseSelf& self, const GroundRows& ground, const BoundaryView& wall, int lane,
             std::size_t at)
      : i_(self), distance_(Lanes::load(ground.distance + lane)) {
    n_[0] = Lanes::load(wall.nx + at), n_[1] = Lanes::load(wall.ny + at);
    n_[2] = Lanes::load(wall.nz + at);
    sums_.clear();
    mnn_ = Lanes::all(0);
  }

  /// Adds one neighbour. One beyond the reach of all lanes adds zero.
  /// \param viscosity  as in DenseSums::add \param held  the part of it that the bed holds
  void add(const NeighborRecord& j, const GroundRecord& ground, const DenseScale& k,
           Lanes viscosity, Lanes held) {
    const Lanes x = difference(i_.x, j.x), y = difference(i_.y, j.y), z = difference(i_.z, j.z);
    const Lanes d = Lanes::all(ground.distance), sum = distance_ + d;
    const Lanes apart = fma(x, x, fma(y, y, z * z));
    const Lanes both = distance_ * Lanes::all(4 * ground.distance);
    const Lanes r2 = max(both + apart, sum * sum);
    if (!any_less(r2, Lanes::all(k.support * k.support))) return;
    const Lanes t = max(Lanes::all(0), fnma(sqrt(r2), Lanes::all(k.to_s), Lanes::all(1)));
    const Lanes w = t * t * t * Lanes::all(j.volume * ground.weight);
    const Lanes up = dot(x, y, z), across = fma(Lanes::all(2), d, up);
    const Lanes tx = fnma(up, n_[0], x), ty = fnma(up, n_[1], y), tz = fnma(up, n_[2], z);
    const Lanes wx = w * tx, wy = w * ty, wz = w * tz;  // along the bed
    const Lanes wn = w * across;
    const Lanes vx = Lanes::all(j.vx), vy = Lanes::all(j.vy), vz = Lanes::all(j.vz);
    const Lanes ax = i_.vx - vx, ay = i_.vy - vy, az = i_.vz - vz;  // the bed slips
    const Lanes hx = i_.vx + vx, hy = i_.vy + vy, hz = i_.vz + vz;  // the bed holds

    add_moment(x, y, z, w);
    mnn_ = fma(w, both, mnn_);
    add_gradient(ax, ay, az, wx, wy, wz);
    add_gradient(hx, hy, hz, wn * n_[0], wn * n_[1], wn * n_[2]);

    const Lanes inv = Lanes::all(1) / (r2 + Lanes::all(k.eta2));
    const Lanes normal = dot(hx, hy, hz) * across;
    const Lanes slips = fma(ax, tx, fma(ay, ty, az * tz)) + normal;
    const Lanes holds = fma(hx, tx, fma(hy, ty, hz * tz));
    const Lanes noise = (viscosity - held) * slips;
    const Lanes along = inv * fma(held, holds, noise), away = inv * fma(held, normal, noise) * wn;
    const Lanes dx = fma(wn, n_[0], wx), dy = fma(wn, n_[1], wy), dz = fma(wn, n_[2], wz);
    const Lanes sxy = Lanes::all(j.sxy), syz = Lanes::all(j.syz), szx = Lanes::all(j.szx);
    ImageSums& s = sums_;
    s.gx = s.gx + dx, s.gy = s.gy + dy, s.gz = s.gz + dz;
    s.ax = fma(Lanes::all(j.sxx), dx, fma(sxy, dy, fma(szx, dz, s.ax)));
    s.ay = fma(sxy, dx, fma(Lanes::all(j.syy), dy, fma(syz, dz, s.ay)));
    s.az = fma(szx, dx, fma(syz, dy, fma(Lanes::all(j.szz), dz, s.az)));
    s.ax = fma(along, wx, fma(away, n_[0], s.ax));
    s.ay = fma(along, wy, fma(away, n_[1], s.ay));
    s.az = fma(along, wz, fma(away, n_[2], s.az));
  }

  /// In the weight of the lanes.
  ImageSums finish(Lanes weight) {
    ImageSums& s = sums_;
    s.mxx = fma(mnn_ * n_[0], n_[0], s.mxx), s.myy = fma(mnn_ * n_[1], n_[1], s.myy);
    s.mzz = fma(mnn_ * n_[2], n_[2], s.mzz), s.mxy = fma(mnn_ * n_[0], n_[1], s.mxy);
    s.myz = fma(mnn_ * n_[1], n_[2], s.myz), s.mzx = fma(mnn_ * n_[2], n_[0], s.mzx);
    s.scale(weight);
    return s;
  }

 private:
  Lanes dot(Lanes x, Lanes y, Lanes z) const { return fma(n_[0], x, fma(n_[1], y, n_[2] * z)); }
  void add_moment(Lanes x, Lanes y, Lanes z, Lanes w) {
    const Lanes wx = w * x, wy = w * y, wz = w * z;
    ImageSums& s = sums_;
    s.mxx = fma(x, wx, s.mxx), s.myy = fma(y, wy, s.myy), s.mzz = fma(z, wz, s.mzz);
    s.mxy = fma(x, wy, s.mxy), s.myz = fma(y, wz, s.myz), s.mzx = fma(z, wx, s.mzx);
  }
  void add_gradient(Lanes ux, Lanes uy, Lanes uz, Lanes dx, Lanes dy, Lanes dz) {
    ImageSums& s = sums_;
    s.lxx = fma(ux, dx, s.lxx), s.lxy = fma(ux, dy, s.lxy), s.lxz = fma(ux, dz, s.lxz);
    s.lyx = fma(uy, dx, s.lyx), s.lyy = fma(uy, dy, s.lyy), s.lyz = fma(uy, dz, s.lyz);
    s.lzx = fma(uz, dx, s.lzx), s.lzy = fma(uz, dy, s.lzy), s.lzz = fma(uz, dz, s.lzz);
  }

  const DenseSelf& i_;
  Lanes n_[3], distance_, mnn_;
  ImageSums sums_;
};

/// The images of all neighbours of a group's lanes in a bed that holds them.
[[gnu::noinline]] inline ImageSums no_slip_sums(const NeighborView& view, std::size_t group,
                                                const GroupRows& rows, const GroundRows& ground,
                                                int lane, const DenseScale& k,
                                                const BoundaryView& wall, Lanes own_viscosity) {
  const DenseSelf self = self_of(rows, lane);
  NoSlipSums images(self, ground, wall, lane, group * group_size + lane);
  const Lanes half = Lanes::all(0.5f * k.viscosity),
              own_held = half * Lanes::load(rows.tension + lane);
  for_each_image(view, group, ground, wall, k, [&](std::uint32_t j) {
    const NeighborRecord& record = view.records[j];
    images.add(record, wall.ground[j], k, fma(half, Lanes::all(record.viscosity), own_viscosity),
               fma(half, Lanes::all(record.held_viscosity()), own_held));
  });
  return images.finish(Lanes::load(ground.weight + lane));
}

}  // namespace sturz::STURZ_ISA
