// SPDX-License-Identifier: Apache-2.0
/// A symmetric 3 x 3 tensor in registers.
#pragma once

namespace sturz {

struct Symmetric {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;

  double trace() const { return xx + yy + zz; }
  /// Half its double contraction: tau^2 of a deviator.
  double norm2() const { return 0.5 * (xx * xx + yy * yy + zz * zz) + xy * xy + yz * yz + zx * zx; }
  double dot(const Symmetric& o) const {
    return xx * o.xx + yy * o.yy + zz * o.zz + 2 * (xy * o.xy + yz * o.yz + zx * o.zx);
  }
  /// this + f o
  Symmetric plus(double f, const Symmetric& o) const {
    return {xx + f * o.xx, yy + f * o.yy, zz + f * o.zz,
            xy + f * o.xy, yz + f * o.yz, zx + f * o.zx};
  }
};

/// s <- Q s Q^T with Q = I + 2/(1+a.a) ([a]x + [a]x^2), the Cayley form of a rotation: exactly
/// orthogonal, so tau is untouched. (ax, ay, az) = half the rotation vector.
inline Symmetric rotated(const Symmetric& s, double ax, double ay, double az) {
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

}  // namespace sturz
