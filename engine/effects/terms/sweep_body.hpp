// SPDX-License-Identifier: Apache-2.0
/// The loops over groups, compiled once per instruction set (see engine/core/lanes.hpp).
#pragma once

#include "engine/effects/terms/dense_sums.hpp"

namespace sturz::STURZ_ISA {

/// A group's values turned from records into lanes-friendly rows.
struct GroupRows {
  alignas(64) std::int32_t x[group_size], y[group_size], z[group_size];
  alignas(64) float volume[group_size], vx[group_size], vy[group_size], vz[group_size];
  alignas(64) float compression[group_size];
  alignas(64) float sxx[group_size], syy[group_size], szz[group_size];
  alignas(64) float sxy[group_size], syz[group_size], szx[group_size];
  alignas(64) float inverse_pressure[group_size];

  explicit GroupRows(const PackedRecord* first) {
    for (int k = 0; k < group_size; ++k) {
      const PackedRecord& p = first[k];
      x[k] = p.x, y[k] = p.y, z[k] = p.z, volume[k] = p.volume;
      vx[k] = p.vx, vy[k] = p.vy, vz[k] = p.vz, compression[k] = p.compression;
      sxx[k] = p.sxx, syy[k] = p.syy, szz[k] = p.szz;
      sxy[k] = p.sxy, syz[k] = p.syz, szx[k] = p.szx;
      inverse_pressure[k] = p.inverse_pressure;
    }
  }
};

/// M : nn / 0.25, between 0 and 1, with nn from the walls' own moment.
inline Lanes wall_share(const DenseSums& s, const Lanes w[6], Lanes scale) {
  const Lanes trace = w[0] + w[1] + w[2];
  const Lanes along = fma(s.mxx, w[0], fma(s.myy, w[1], s.mzz * w[2])) +
                      Lanes::all(2) * fma(s.mxy, w[3], fma(s.myz, w[4], s.mzx * w[5]));
  const Lanes share = Lanes::all(4) * scale * along / max(trace, Lanes::all(1e-6f));
  const Lanes one = Lanes::all(1);
  return select_less(share, one, max(share, Lanes::all(0)), one);
}

/// Turns sums into acceleration, corrected velocity gradient and diffusion rate.
inline void finish_dense(const DenseSums& s, const GroupRows& rows, int lane,
                         const DenseScale& k, const BoundaryView& wall, const SweepOutput& out,
                         std::size_t at) {
  const Lanes sxx = Lanes::load(rows.sxx + lane), syy = Lanes::load(rows.syy + lane);
  const Lanes szz = Lanes::load(rows.szz + lane), sxy = Lanes::load(rows.sxy + lane);
  const Lanes syz = Lanes::load(rows.syz + lane), szx = Lanes::load(rows.szx + lane);
  const Lanes one = Lanes::all(1);
  const Lanes density = Lanes::all(k.density) * (one + Lanes::load(rows.compression + lane));
  const Lanes factor = Lanes::all(-k.gradient) / density;
  (factor * fma(sxx, s.gx, fma(sxy, s.gy, fma(szx, s.gz, s.ax)))).store(out.ax + at);
  (factor * fma(sxy, s.gx, fma(syy, s.gy, fma(syz, s.gz, s.ay)))).store(out.ay + at);
  (factor * fma(szx, s.gx, fma(syz, s.gy, fma(szz, s.gz, s.az)))).store(out.az + at);

  Lanes w[6];
  for (int c = 0; c < 6; ++c) w[c] = Lanes::load(wall.moment[c] + at);
  const Lanes share = wall_share(s, w, Lanes::all(k.moment));
  share.store(out.wall_share + at);
  for (Lanes& c : w) c = share * c;
  const Correction b(s, Lanes::all(k.moment), w);
  for (int c = 0; c < 6; ++c) w[c] = share * Lanes::load(wall.gradient[c] + at);
  const Lanes scale = Lanes::all(k.gradient);
  auto row = [&](Lanes x, Lanes y, Lanes z, float* ox, float* oy, float* oz) {
    fma(x, b.xx, fma(y, b.xy, z * b.zx)).store(ox + at);
    fma(x, b.xy, fma(y, b.yy, z * b.yz)).store(oy + at);
    fma(x, b.zx, fma(y, b.yz, z * b.zz)).store(oz + at);
  };
  row(fma(scale, s.lxx, w[0]), fma(scale, s.lxy, w[3]), fma(scale, s.lxz, w[5]), out.lxx,
      out.lxy, out.lxz);
  row(fma(scale, s.lyx, w[3]), fma(scale, s.lyy, w[1]), fma(scale, s.lyz, w[4]), out.lyx,
      out.lyy, out.lyz);
  row(fma(scale, s.lzx, w[5]), fma(scale, s.lzy, w[4]), fma(scale, s.lzz, w[2]), out.lzx,
      out.lzy, out.lzz);

  // Density has no mirror image (it goes on rising towards the bed): its gradient is taken from
  // the neighbours alone.
  for (Lanes& c : w) c = Lanes::all(0);
  const Correction own(s, Lanes::all(k.moment), w);
  const Lanes bx = fma(own.xx, s.nx, fma(own.xy, s.ny, own.zx * s.nz));
  const Lanes by = fma(own.xy, s.nx, fma(own.yy, s.ny, own.yz * s.nz));
  const Lanes bz = fma(own.zx, s.nx, fma(own.yz, s.ny, own.zz * s.nz));
  const Lanes linear = Lanes::all(k.moment) * fma(bx, s.gx, fma(by, s.gy, bz * s.gz));
  (Lanes::all(k.diffusion) * (s.d - linear)).store(out.diffusion + at);
}

/// Deviator of the smoothed ratio's rate: zeta' (Sum w S_j - S_i Sum w).
inline void finish_ratio(const RatioSums& r, const GroupRows& rows, int lane, const DenseScale& k,
                         const SweepOutput& out, std::size_t at) {
  const Lanes v = r.weight * Lanes::load(rows.inverse_pressure + lane);
  const Lanes scale = Lanes::all(k.smoothing), third = Lanes::all(1.0f / 3);
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

template <bool smooth>
inline void dense_groups(const PackedView& view, const SweepConstants& constants,
                        const BoundaryView& wall, const SweepOutput& out, std::size_t first_group,
                        std::size_t last_group) {
  const DenseScale scale = dense_scale(constants, view.unit_m);
  for (std::size_t g = first_group; g < last_group; ++g) {
    const std::size_t first = g * group_size;
    const GroupRows rows(view.records + first);
    const std::uint32_t* begin = view.list + view.list_begin[g];
    const std::uint32_t* end = view.list + view.list_begin[g + 1];
    for (int lane = 0; lane < group_size; lane += Lanes::width) {
      const DenseSelf self{IntLanes::load(rows.x + lane), IntLanes::load(rows.y + lane),
                           IntLanes::load(rows.z + lane), Lanes::load(rows.vx + lane),
                           Lanes::load(rows.vy + lane),   Lanes::load(rows.vz + lane),
                           Lanes::load(rows.compression + lane)};
      DenseSums sums;
      sums.clear();
      RatioSums ratio;
      if constexpr (smooth) ratio.clear();
      for (const std::uint32_t* j = begin; j != end; ++j) {
        const Lanes w = sums.add(self, view.records[*j], scale);
        if constexpr (smooth) ratio.add(view.records[*j], w);
      }
      finish_dense(sums, rows, lane, scale, wall, out, first + lane);
      if constexpr (smooth) finish_ratio(ratio, rows, lane, scale, out, first + lane);
    }
  }
}

inline void dense_sweep(const PackedView& view, const SweepConstants& constants,
                        const BoundaryView& wall, const SweepOutput& out,
                        std::size_t first_group, std::size_t last_group) {
  if (constants.stress_smoothing > 0)
    dense_groups<true>(view, constants, wall, out, first_group, last_group);
  else
    dense_groups<false>(view, constants, wall, out, first_group, last_group);
}

inline std::size_t tight_list(const PackedRecord* records, std::size_t first, int n_in_group,
                              const std::uint32_t* candidates, std::size_t n_candidates,
                              float reach_units, std::uint32_t* out) {
  alignas(64) std::int32_t x[group_size], y[group_size], z[group_size];
  for (int k = 0; k < group_size; ++k) {
    const PackedRecord& p = records[first + (k < n_in_group ? k : 0)];
    x[k] = p.x, y[k] = p.y, z[k] = p.z;
  }
  const Lanes reach2 = Lanes::all(reach_units * reach_units);
  std::size_t n = 0;
  for (std::size_t c = 0; c < n_candidates; ++c) {
    const PackedRecord& j = records[candidates[c]];
    bool near = false;
    for (int lane = 0; lane < group_size && !near; lane += Lanes::width) {
      const Lanes rx = difference(IntLanes::load(x + lane), j.x);
      const Lanes ry = difference(IntLanes::load(y + lane), j.y);
      const Lanes rz = difference(IntLanes::load(z + lane), j.z);
      near = any_less(fma(rx, rx, fma(ry, ry, rz * rz)), reach2);
    }
    out[n] = candidates[c];
    n += near;
  }
  return n;
}

}  // namespace sturz::STURZ_ISA
