// SPDX-License-Identifier: Apache-2.0
/// Artificial stress of cohesive grains (Monaghan 2000, Gray et al. 2001; docs/physics.md B.4, I1).
///
/// In tension, neighbours that come closer pull each other more: pairs would collapse. A pressure
/// epsilon T (f_i + f_j) f^4, f = W(r)/W(dx), pushes them apart below one spacing only. T is a
/// bound of the largest principal tension, 2 tau/sqrt(3) - p.
#pragma once

#include "engine/effects/dense/sums.hpp"

namespace sturz::STURZ_ISA {

struct TensionSums {
  Lanes bx, by, bz, cx, cy, cz;  // Sum a_j f^4 d and Sum f^4 d

  void clear() { bx = by = bz = cx = cy = cz = Lanes::all(0); }
  /// \param w  what DenseSums::add gave back for the pair
  void add(const DenseSelf& i, const NeighborRecord& j, const DenseScale& k, Lanes w) {
    const Lanes rx = difference(i.x, j.x), ry = difference(i.y, j.y), rz = difference(i.z, j.z);
    const Lanes r2 = fma(rx, rx, fma(ry, ry, rz * rz));
    const Lanes t = max(Lanes::all(0), fnma(sqrt(r2), Lanes::all(k.to_s), Lanes::all(1)));
    const Lanes t2 = t * t;
    // Wendland C2 is t^4 (5 - 4t) up to a factor.
    const Lanes f = t2 * t2 * fnma(Lanes::all(4), t, Lanes::all(5)) * Lanes::all(k.inv_w_spacing);
    const Lanes f2 = f * f, v = f2 * f2 * w;
    const Lanes dx = v * rx, dy = v * ry, dz = v * rz, a = Lanes::all(j.tension);
    bx = fma(a, dx, bx), by = fma(a, dy, by), bz = fma(a, dz, bz);
    cx = cx + dx, cy = cy + dy, cz = cz + dz;
  }
};

}  // namespace sturz::STURZ_ISA
