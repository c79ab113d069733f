// SPDX-License-Identifier: Apache-2.0
/// What a column gathers from the columns of another set, with the function W of columns/sums.hpp:
///   thickness  h += V_j W
///   momentum   a -= V_j (G_i + G_j)/2 grad W, the gradient of that thickness; times the ratio of
///              densities it is the opposite of what the other side gathers of this pair
#pragma once

#include "engine/effects/columns/sums.hpp"

namespace sturz::STURZ_ISA {

struct AcrossSums {
  Lanes thickness, ax, ay, az, approach;

  void clear() { thickness = ax = ay = az = approach = Lanes::all(0); }

  void add(const ColumnSelf& i, const ColumnRecord& j, const ColumnScale& k) {
    const Lanes zero = Lanes::all(0), one = Lanes::all(1);
    const Lanes unit = Lanes::all(k.unit);
    const Lanes rx = unit * difference(i.x, j.x), ry = unit * difference(i.y, j.y);
    Lanes rz = unit * difference(i.z, j.z), lift = rz;
    if (k.steep) {
      const Lanes share = i.share * Lanes::all(j.share);
      rz = rz * share, lift = rz * share;
    }
    const Lanes r2 = fma(rx, rx, fma(ry, ry, rz * rz));
    const Lanes iq = max(i.inverse_radius, Lanes::all(j.inverse_radius));
    if (!any_less(r2 * iq * iq, one)) return;
    const Lanes q = sqrt(r2) * iq;
    const Lanes t = max(zero, one - q), t3 = t * t * t, iq2 = iq * iq;
    const Lanes w = Lanes::all(2.2281692f) * iq2 * t3 * t * fma(Lanes::all(4), q, one);
    thickness = fma(Lanes::all(j.volume), w, thickness);
    const Lanes ux = i.vx - Lanes::all(j.vx), uy = i.vy - Lanes::all(j.vy);
    const Lanes uz = i.vz - Lanes::all(j.vz);
    approach = max(approach, select_less(zero, t, fma(ux, ux, fma(uy, uy, uz * uz)), zero));
    const Lanes d = Lanes::all(44.563384f * j.volume) * iq2 * iq2 * t3;
    const Lanes force = d * Lanes::all(0.5f) * (i.lateral + Lanes::all(j.lateral));
    ax = fma(force, rx, ax), ay = fma(force, ry, ay), az = fma(force, lift, az);
  }
};

}  // namespace sturz::STURZ_ISA
