// SPDX-License-Identifier: Apache-2.0
/// What a depth-averaged column gathers from its neighbours in one loop.
///
/// With the two-dimensional Wendland C2 function of support R, q = r/R, t = max(0, 1 - q):
///   W = 7/(pi R^2) t^4 (4 q + 1),  grad_i W = -(140/pi) t^3/R^4 r_ij
/// r_ij is the straight line between two points of the ground: the tangent plane's distance where
/// the ground is flat across R, and symmetric everywhere. The smaller R of the two columns counts.
/// Between columns on steep ground only the share s_i s_j of the rise counts (ADR 0026), down to
/// none: W of (x, y, s_i s_j z), and its gradient.
///   thickness   h += V_j W
///   momentum    a -= V_j [ (K g_n)_ij + Pi_ij ] grad W, antisymmetric; the first part is the
///               gradient of the smoothed thickness (McDougall & Hungr 2004), the second Monaghan's
///               viscosity Pi = -alpha c_ij mu / h_ij, mu = (R/2) v.r/(r^2 + 0.01 (R/2)^2) < 0
#pragma once

#include "engine/core/lanes.hpp"
#include "engine/neighbors/column_records.hpp"

namespace sturz::STURZ_ISA {

/// Constants in the units of the loop: positions in fixed-point units.
struct ColumnScale {
  float unit;       ///< metres per position unit
  float viscosity;  ///< alpha
  bool steep;
  explicit ColumnScale(const ColumnConstants& c, double unit_m)
      : unit(static_cast<float>(unit_m)),
        viscosity(static_cast<float>(c.viscosity)),
        steep(c.steep) {}
};

/// A group's values turned from records into rows; lanes beyond its end repeat the last column.
struct ColumnRows {
  alignas(64) std::int32_t x[group_size], y[group_size], z[group_size];
  alignas(64) float vx[group_size], vy[group_size], vz[group_size], inverse_radius[group_size];
  alignas(64) float thickness[group_size], lateral[group_size], wave_speed[group_size];
  alignas(64) float share[group_size];

  ColumnRows(const ColumnRecord* first, int n) {
    for (int k = 0; k < group_size; ++k) {
      const ColumnRecord& c = first[k < n ? k : n - 1];
      x[k] = c.x, y[k] = c.y, z[k] = c.z, vx[k] = c.vx, vy[k] = c.vy, vz[k] = c.vz;
      inverse_radius[k] = c.inverse_radius, thickness[k] = c.thickness;
      lateral[k] = c.lateral, wave_speed[k] = c.wave_speed, share[k] = c.share;
    }
  }
};

/// The lanes' own values.
struct ColumnSelf {
  IntLanes x, y, z;
  Lanes vx, vy, vz, inverse_radius, thickness, lateral, wave_speed, share;
  ColumnSelf(const ColumnRows& r, int lane)
      : x(IntLanes::load(r.x + lane)),
        y(IntLanes::load(r.y + lane)),
        z(IntLanes::load(r.z + lane)),
        vx(Lanes::load(r.vx + lane)),
        vy(Lanes::load(r.vy + lane)),
        vz(Lanes::load(r.vz + lane)),
        inverse_radius(Lanes::load(r.inverse_radius + lane)),
        thickness(Lanes::load(r.thickness + lane)),
        lateral(Lanes::load(r.lateral + lane)),
        wave_speed(Lanes::load(r.wave_speed + lane)),
        share(Lanes::load(r.share + lane)) {}
};

struct ColumnSums {
  Lanes thickness, density, ax, ay, az, divergence, approach;

  void clear() { thickness = density = ax = ay = az = divergence = approach = Lanes::all(0); }

  /// Adds one neighbour to all lanes; beyond the support it adds zero, a lane itself only to
  /// thickness and density.
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
    density = density + w;

    const Lanes ux = i.vx - Lanes::all(j.vx), uy = i.vy - Lanes::all(j.vy);
    const Lanes uz = i.vz - Lanes::all(j.vz);
    const Lanes ur = fma(ux, rx, fma(uy, ry, uz * lift));
    const Lanes u2 = fma(ux, ux, fma(uy, uy, uz * uz));
    approach = max(approach, select_less(zero, t, u2, zero));
    const Lanes d = Lanes::all(44.563384f * j.volume) * iq2 * iq2 * t3;
    // Pi from means of c and h; h_s = R/2.
    const Lanes depth = i.thickness + Lanes::all(j.thickness);
    const Lanes speed = i.wave_speed + Lanes::all(j.wave_speed);
    const Lanes below = depth * fma(r2, iq2, Lanes::all(0.0025f));
    const Lanes pi = max(zero, zero - Lanes::all(0.5f * k.viscosity) * speed * ur * iq) / below;
    const Lanes force = d * fma(Lanes::all(0.5f), i.lateral + Lanes::all(j.lateral), pi);
    ax = fma(force, rx, ax), ay = fma(force, ry, ay), az = fma(force, lift, az);
    divergence = fma(d, ur, divergence);
  }
};

}  // namespace sturz::STURZ_ISA
