// SPDX-License-Identifier: Apache-2.0
/// What a dispersed grain gathers in the dense loop besides DenseSums.
///
/// With w = V_j t^3 (V of the record), W = weight_j w and D = W r_ij:
///   kinetic momentum  K += sigma_k,j D, G += D     a += -(weight_i/rho)(K + sigma_k,i G)      B.4
///   pair gradient     E += (v_i - v_j) (x) D, symmetric part: what that force's work goes with
///   conduction        H += W 4/(1/k_i + 1/k_j) (theta_j - theta_i)                            B.6
///   neighbours        N += 1 inside the support
/// Every sum takes the product of both weights, so that momentum, energy and granular energy of a
/// pair cancel. Production by the corrected gradient instead would make energy: where neighbours
/// are few it is up to twice the gradient that the force works on. Contact stresses stay with the
/// record's volumes: see KineticRecord.
#pragma once

#include "engine/effects/dense/tension_sums.hpp"

namespace sturz::STURZ_ISA {

/// The lanes' own values.
struct KineticSelf {
  Lanes theta, resistance, viscosity;
};

struct KineticSums {
  Lanes kx, ky, kz, gx, gy, gz, conducted, count;
  Lanes exx, eyy, ezz, exy, eyz, ezx;

  void clear() {
    const Lanes o = Lanes::all(0);
    kx = ky = kz = gx = gy = gz = conducted = o;
    exx = eyy = ezz = exy = eyz = ezx = o;
    count = Lanes::all(-1);  // the lane itself
  }
  /// \param w  what DenseSums::add gave back for the pair
  void add(const DenseSelf& i, const KineticSelf& self, const NeighborRecord& j,
           const KineticRecord& k, Lanes w) {
    const Lanes rx = difference(i.x, j.x), ry = difference(i.y, j.y), rz = difference(i.z, j.z);
    const Lanes zero = Lanes::all(0), one = Lanes::all(1);
    count = count + select_less(zero, w, one, zero);
    const Lanes v = w * Lanes::all(k.weight);
    const Lanes dx = v * rx, dy = v * ry, dz = v * rz;
    gx = gx + dx, gy = gy + dy, gz = gz + dz;
    const Lanes xy = Lanes::all(k.xy), yz = Lanes::all(k.yz), zx = Lanes::all(k.zx);
    kx = fma(Lanes::all(k.xx), dx, fma(xy, dy, fma(zx, dz, kx)));
    ky = fma(xy, dx, fma(Lanes::all(k.yy), dy, fma(yz, dz, ky)));
    kz = fma(zx, dx, fma(yz, dy, fma(Lanes::all(k.zz), dz, kz)));
    const Lanes ux = i.vx - Lanes::all(j.vx), uy = i.vy - Lanes::all(j.vy);
    const Lanes uz = i.vz - Lanes::all(j.vz);
    exx = fma(ux, dx, exx), eyy = fma(uy, dy, eyy), ezz = fma(uz, dz, ezz);
    exy = fma(ux, dy, fma(uy, dx, exy));
    eyz = fma(uy, dz, fma(uz, dy, eyz));
    ezx = fma(uz, dx, fma(ux, dz, ezx));
    const Lanes conduction = Lanes::all(4) / (self.resistance + Lanes::all(k.resistance));
    conducted = fma(v * conduction, Lanes::all(k.theta) - self.theta, conducted);
  }
};

}  // namespace sturz::STURZ_ISA
