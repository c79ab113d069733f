// SPDX-License-Identifier: Apache-2.0
/// The loops over groups, compiled once per instruction set (see engine/core/lanes.hpp).
#pragma once

#include "engine/effects/kinetic/sums.hpp"

namespace sturz::STURZ_ISA {

/// A group's values turned from records into lanes-friendly rows.
struct GroupRows {
  alignas(64) std::int32_t x[group_size], y[group_size], z[group_size];
  alignas(64) float volume[group_size], vx[group_size], vy[group_size], vz[group_size];
  alignas(64) float density_change[group_size];
  alignas(64) float sxx[group_size], syy[group_size], szz[group_size];
  alignas(64) float sxy[group_size], syz[group_size], szx[group_size];
  alignas(64) float viscosity[group_size], tension[group_size];

  explicit GroupRows(const NeighborRecord* first) {
    for (int k = 0; k < group_size; ++k) {
      const NeighborRecord& p = first[k];
      x[k] = p.x, y[k] = p.y, z[k] = p.z, volume[k] = p.volume;
      vx[k] = p.vx, vy[k] = p.vy, vz[k] = p.vz, density_change[k] = p.density_change;
      sxx[k] = p.sxx, syy[k] = p.syy, szz[k] = p.szz;
      sxy[k] = p.sxy, syz[k] = p.syz, szx[k] = p.szx;
      viscosity[k] = p.viscosity, tension[k] = p.tension;
    }
  }
};

/// M : nn / 0.25, between 0 and 1, with nn from the walls' own moment.
inline Lanes mirror_weight(const DenseSums& s, const Lanes w[6], Lanes scale) {
  const Lanes trace = w[0] + w[1] + w[2];
  const Lanes along = fma(s.mxx, w[0], fma(s.myy, w[1], s.mzz * w[2])) +
                      Lanes::all(2) * fma(s.mxy, w[3], fma(s.myz, w[4], s.mzx * w[5]));
  const Lanes share = Lanes::all(4) * scale * along / max(trace, Lanes::all(1e-6f));
  const Lanes one = Lanes::all(1);
  return select_less(share, one, max(share, Lanes::all(0)), one);
}

/// What ground and walls add to the moment matrix and, before correction, to the velocity gradient:
/// 2 W_plane(d) d n n and 2 W_plane(d) v_n n n (SmoothingKernel::plane_integral), xx yy zz xy yz
/// zx.
struct MirrorContribution {
  Lanes moment[6], gradient[6];

  MirrorContribution(const BoundaryView& wall, const GroupRows& rows, int lane, const DenseScale& k,
                     std::size_t at) {
    const Lanes zero = Lanes::all(0);
    const Lanes d = max(Lanes::load(wall.distance + at), zero);
    const Lanes y = max(fnma(d, Lanes::all(k.inv_support), Lanes::all(1)), zero), y2 = y * y;
    const Lanes tail = fma(y, fma(y, Lanes::all(4.0f / 7), Lanes::all(-1.5f)), Lanes::all(1));
    const Lanes plane = Lanes::all(k.plane) * y2 * y2 * y * tail;
    const Lanes nx = Lanes::load(wall.nx + at), ny = Lanes::load(wall.ny + at);
    const Lanes nz = Lanes::load(wall.nz + at);
    const Lanes vn = fma(Lanes::load(rows.vx + lane), nx,
                         fma(Lanes::load(rows.vy + lane), ny, Lanes::load(rows.vz + lane) * nz));
    // Farther than the support: nothing, whatever the distance (it may be a far lower bound).
    const Lanes m = select_less(zero, plane, plane * d, zero);
    const Lanes g = select_less(zero, plane, plane * vn, zero);
    const Lanes nn[6] = {nx * nx, ny * ny, nz * nz, nx * ny, ny * nz, nz * nx};
    for (int c = 0; c < 6; ++c) moment[c] = m * nn[c], gradient[c] = g * nn[c];
    if (!wall.moment[0]) return;
    for (int c = 0; c < 6; ++c) {
      moment[c] = moment[c] + Lanes::load(wall.moment[c] + at);
      gradient[c] = gradient[c] + Lanes::load(wall.gradient[c] + at);
    }
  }
};

/// Turns sums into acceleration, corrected velocity gradient and diffusion rate.
/// \param dilation_ratio  true volume over that of the records, 1 in a dense mass: sums over
///                neighbours that dilated alike are too small by it
/// \tparam dispersed  whether the group may be a cloud
/// \return trace of the moment that ground and walls add
template <bool dispersed>
inline Lanes finish_dense(const DenseSums& s, const GroupRows& rows, int lane, const DenseScale& k,
                          const BoundaryView& wall, const SweepOutput& out, std::size_t at,
                          Lanes dilation_ratio) {
  const Lanes sxx = Lanes::load(rows.sxx + lane), syy = Lanes::load(rows.syy + lane);
  const Lanes szz = Lanes::load(rows.szz + lane), sxy = Lanes::load(rows.sxy + lane);
  const Lanes syz = Lanes::load(rows.syz + lane), szx = Lanes::load(rows.szx + lane);
  const Lanes one = Lanes::all(1);
  const Lanes density = Lanes::all(k.density) * (one + Lanes::load(rows.density_change + lane));
  const Lanes factor = Lanes::all(-k.gradient) / density;
  (factor * fma(sxx, s.gx, fma(sxy, s.gy, fma(szx, s.gz, s.ax)))).store(out.ax + at);
  (factor * fma(sxy, s.gx, fma(syy, s.gy, fma(syz, s.gz, s.ay)))).store(out.ay + at);
  (factor * fma(szx, s.gx, fma(syz, s.gy, fma(szz, s.gz, s.az)))).store(out.az + at);

  const MirrorContribution mirror(wall, rows, lane, k, at);
  Lanes w[6];
  for (int c = 0; c < 6; ++c) w[c] = mirror.moment[c];
  const Lanes moment = Lanes::all(k.moment) * dilation_ratio;
  const Lanes share = mirror_weight(s, w, moment);
  share.store(out.mirror_weight + at);
  for (Lanes& c : w) c = share * c;
  const Lanes mirror_trace = w[0] + w[1] + w[2];
  const Correction b =
      dispersed ? Correction::in_a_cloud(s, moment, w, dilation_ratio) : Correction(s, moment, w);
  for (int c = 0; c < 6; ++c) w[c] = share * mirror.gradient[c];
  const Lanes scale = Lanes::all(k.gradient) * dilation_ratio;
  auto row = [&](Lanes x, Lanes y, Lanes z, float* ox, float* oy, float* oz) {
    fma(x, b.xx, fma(y, b.xy, z * b.zx)).store(ox + at);
    fma(x, b.xy, fma(y, b.yy, z * b.yz)).store(oy + at);
    fma(x, b.zx, fma(y, b.yz, z * b.zz)).store(oz + at);
  };
  row(fma(scale, s.lxx, w[0]), fma(scale, s.lxy, w[3]), fma(scale, s.lxz, w[5]), out.lxx, out.lxy,
      out.lxz);
  row(fma(scale, s.lyx, w[3]), fma(scale, s.lyy, w[1]), fma(scale, s.lyz, w[4]), out.lyx, out.lyy,
      out.lyz);
  row(fma(scale, s.lzx, w[5]), fma(scale, s.lzy, w[4]), fma(scale, s.lzz, w[2]), out.lzx, out.lzy,
      out.lzz);

  // Density is not mirrored (it goes on rising towards the bed): its gradient is taken from
  // the neighbours alone.
  for (Lanes& c : w) c = Lanes::all(0);
  const Correction own(s, Lanes::all(k.moment), w);
  const Lanes bx = fma(own.xx, s.nx, fma(own.xy, s.ny, own.zx * s.nz));
  const Lanes by = fma(own.xy, s.nx, fma(own.yy, s.ny, own.yz * s.nz));
  const Lanes bz = fma(own.zx, s.nx, fma(own.yz, s.ny, own.zz * s.nz));
  const Lanes linear = Lanes::all(k.moment) * fma(bx, s.gx, fma(by, s.gy, bz * s.gz));
  (Lanes::all(k.diffusion) * (s.d - linear)).store(out.diffusion + at);
  return mirror_trace;
}

/// A third of the moment's trace: 1 inside a dense mass, about a half at its surface.
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

/// A group's kinetic records in rows.
struct KineticRows {
  alignas(64) float dilation_ratio[group_size], weight[group_size], theta[group_size];
  alignas(64) float resistance[group_size], viscosity[group_size];
  alignas(64) float xx[group_size], yy[group_size], zz[group_size];
  alignas(64) float xy[group_size], yz[group_size], zx[group_size];

  explicit KineticRows(const KineticRecord* first) {
    for (int n = 0; n < group_size; ++n) {
      const KineticRecord& k = first[n];
      dilation_ratio[n] = k.dilation_ratio, weight[n] = k.weight, theta[n] = k.theta;
      resistance[n] = k.resistance, viscosity[n] = k.viscosity;
      xx[n] = k.xx, yy[n] = k.yy, zz[n] = k.zz;
      xy[n] = k.xy, yz[n] = k.yz, zx[n] = k.zx;
    }
  }
};

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

/// The lanes' own values of a group.
inline DenseSelf self_of(const GroupRows& rows, int lane) {
  return {IntLanes::load(rows.x + lane),
          IntLanes::load(rows.y + lane),
          IntLanes::load(rows.z + lane),
          Lanes::load(rows.vx + lane),
          Lanes::load(rows.vy + lane),
          Lanes::load(rows.vz + lane),
          Lanes::load(rows.density_change + lane)};
}

/// \tparam completeness  whether SweepOutput::support_completeness is wanted
/// \tparam tension  whether artificial stress acts
template <bool smooth, bool completeness, bool tension>
inline void dense_group(const NeighborView& view, const DenseScale& scale, const BoundaryView& wall,
                        const SweepOutput& out, std::size_t group) {
  const std::size_t first = group * group_size;
  const GroupRows rows(view.records + first);
  const std::uint32_t* begin = view.list(group);
  const std::uint32_t* end = begin + view.list_size(group);
  for (int lane = 0; lane < group_size; lane += Lanes::width) {
    const DenseSelf self = self_of(rows, lane);
    DenseSums sums;
    sums.clear();
    RatioSums ratio;
    if constexpr (smooth) ratio.clear();
    TensionSums pull;
    if constexpr (tension) pull.clear();
    const Lanes half = Lanes::all(0.5f * scale.viscosity);
    const Lanes own = half * Lanes::load(rows.viscosity + lane);
    for (const std::uint32_t* j = begin; j != end; ++j) {
      const Lanes viscosity = fma(half, Lanes::all(view.records[*j].viscosity), own);
      const Lanes w = sums.add(self, view.records[*j], scale, viscosity);
      if constexpr (smooth) ratio.add(view.records[*j], scale, w);
      if constexpr (tension) pull.add(self, view.records[*j], scale, w);
    }
    const Lanes mirror_trace =
        finish_dense<false>(sums, rows, lane, scale, wall, out, first + lane, Lanes::all(1));
    if constexpr (completeness)
      support_completeness(sums, scale, mirror_trace)
          .store(out.support_completeness + first + lane);
    if constexpr (tension) finish_tension(pull, rows, lane, scale, out, first + lane);
    if constexpr (smooth) finish_ratio(ratio, rows, lane, scale, out, first + lane);
  }
}

/// The loop with the terms of this step.
template <bool completeness>
inline auto pick_dense(const SweepConstants& c) {
  if (c.stress_smoothing > 0)
    return c.tension ? &dense_group<true, completeness, true>
                     : &dense_group<true, completeness, false>;
  return c.tension ? &dense_group<false, completeness, true>
                   : &dense_group<false, completeness, false>;
}

inline void dense_sweep(const NeighborView& view, const SweepConstants& constants,
                        const BoundaryView& wall, const SweepOutput& out, std::size_t first_group,
                        std::size_t last_group) {
  const DenseScale scale = dense_scale(constants, view.unit_m);
  const auto group = pick_dense<false>(constants);
  for (std::size_t g = first_group; g < last_group; ++g) group(view, scale, wall, out, g);
}

/// A group in which some grain is dispersed, or a neighbour is.
template <bool smooth, bool tension>
inline void kinetic_group(const NeighborView& view, const KineticView& dispersed,
                          const DenseScale& scale, const BoundaryView& wall, const SweepOutput& out,
                          std::size_t group) {
  const std::size_t first = group * group_size;
  const GroupRows rows(view.records + first);
  const KineticRows own(dispersed.records + first);
  const std::uint32_t* begin = view.list(group);
  const std::uint32_t* end = begin + view.list_size(group);
  for (int lane = 0; lane < group_size; lane += Lanes::width) {
    const DenseSelf self = self_of(rows, lane);
    const KineticSelf kinetic{Lanes::load(own.theta + lane), Lanes::load(own.resistance + lane),
                              Lanes::load(own.viscosity + lane)};
    DenseSums sums;
    sums.clear();
    KineticSums more;
    more.clear();
    RatioSums ratio;
    if constexpr (smooth) ratio.clear();
    TensionSums pull;
    if constexpr (tension) pull.clear();
    const Lanes half = Lanes::all(0.5f * scale.viscosity), mine = half * kinetic.viscosity;
    for (const std::uint32_t* j = begin; j != end; ++j) {
      const KineticRecord& k = dispersed.records[*j];
      const Lanes viscosity = fma(half, Lanes::all(k.viscosity), mine);
      const Lanes w = sums.add(self, view.records[*j], scale, viscosity);
      more.add(self, kinetic, view.records[*j], k, w);
      if constexpr (smooth) ratio.add(view.records[*j], scale, w);
      if constexpr (tension) pull.add(self, view.records[*j], scale, w);
    }
    const std::size_t at = first + lane;
    const Lanes mirror_trace = finish_dense<true>(sums, rows, lane, scale, wall, out, at,
                                                  Lanes::load(own.dilation_ratio + lane));
    finish_kinetic(more, sums, rows, own, lane, scale, mirror_trace, out, at);
    if constexpr (tension) finish_tension(pull, rows, lane, scale, out, at);
    if constexpr (smooth) finish_ratio(ratio, rows, lane, scale, out, at);
  }
}

inline auto pick_kinetic(const SweepConstants& c) {
  if (c.stress_smoothing > 0)
    return c.tension ? &kinetic_group<true, true> : &kinetic_group<true, false>;
  return c.tension ? &kinetic_group<false, true> : &kinetic_group<false, false>;
}

/// Whether no grain in the group or near it is dispersed.
inline bool dense_around(const NeighborView& view, const KineticView& dispersed,
                         std::size_t group) {
  const std::uint32_t* list = view.list(group);
  const std::size_t n = view.list_size(group);
  unsigned dense_group = dispersed.dense_group[group];
  for (std::size_t k = 0; k < n; ++k) dense_group &= dispersed.dense_group[list[k] / group_size];
  return dense_group != 0;
}

/// What a dense group has in the outputs that only the kinetic sums write. Its neighbours are not
/// counted: a grain that has lost them shows by its support completeness first.
inline void write_dense_group(const SweepOutput& out, std::size_t group) {
  for (std::size_t i = group * group_size; i < (group + 1) * group_size; ++i) {
    out.neighbors[i] = SweepOutput::uncounted;
    out.conducted[i] = 0;
    for (float* column : out.pair_gradient) column[i] = 0;
  }
}

inline void kinetic_sweep(const NeighborView& view, const KineticView& dispersed,
                          const SweepConstants& constants, const BoundaryView& wall,
                          const SweepOutput& out, std::size_t first_group, std::size_t last_group) {
  const DenseScale scale = dense_scale(constants, view.unit_m);
  const auto dense = pick_dense<true>(constants);
  const auto kinetic = pick_kinetic(constants);
  bool in_dispersed = false;
  std::int64_t since = 0;
  const auto turn = [&](bool to_dispersed) {  // the clock is read where the kind of group changes
    if (!dispersed.clock || in_dispersed == to_dispersed) return;
    const std::int64_t now = dispersed.clock->now_ns();
    if (in_dispersed) dispersed.clock->spent_ns += now - since;
    since = now;
    in_dispersed = to_dispersed;
  };
  for (std::size_t g = first_group; g < last_group; ++g) {
    const bool is_dense = dense_around(view, dispersed, g);
    turn(!is_dense);
    if (is_dense) {
      dense(view, scale, wall, out, g);
      write_dense_group(out, g);
    } else {
      kinetic(view, dispersed, scale, wall, out, g);
    }
  }
  turn(false);
}

inline std::size_t tight_list(const NeighborRecord* records, std::size_t first, int n_in_group,
                              const std::uint32_t* candidates, std::size_t n_candidates,
                              float radius_units, std::uint32_t* out) {
  alignas(64) std::int32_t x[group_size], y[group_size], z[group_size];
  for (int k = 0; k < group_size; ++k) {
    const NeighborRecord& p = records[first + (k < n_in_group ? k : 0)];
    x[k] = p.x, y[k] = p.y, z[k] = p.z;
  }
  const Lanes radius2 = Lanes::all(radius_units * radius_units);
  std::size_t n = 0;
  for (std::size_t c = 0; c < n_candidates; ++c) {
    const NeighborRecord& j = records[candidates[c]];
    bool near = false;
    for (int lane = 0; lane < group_size && !near; lane += Lanes::width) {
      const Lanes rx = difference(IntLanes::load(x + lane), j.x);
      const Lanes ry = difference(IntLanes::load(y + lane), j.y);
      const Lanes rz = difference(IntLanes::load(z + lane), j.z);
      near = any_less(fma(rx, rx, fma(ry, ry, rz * rz)), radius2);
    }
    out[n] = candidates[c];
    n += near;
  }
  return n;
}

}  // namespace sturz::STURZ_ISA
