// SPDX-License-Identifier: Apache-2.0
/// A group's records turned into rows for the lanes.
#pragma once

#include "engine/effects/dense/sums.hpp"

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

}  // namespace sturz::STURZ_ISA
