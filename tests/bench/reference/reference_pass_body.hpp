// SPDX-License-Identifier: Apache-2.0
/// The loops themselves, compiled several times with different flags into namespaces of their own.
#pragma once

#include "tests/bench/reference/reference_pass.hpp"

#include <math.h>

namespace sturz::bench::STURZ_REFERENCE {

inline void gather_records(const ReferenceColumns& p, const ReferenceNumbers& k, float* records) {
  for (std::size_t i = 0; i < p.n; ++i) {
    float* r = records + record_floats * i;
    r[0] = p.x[i], r[1] = p.y[i], r[2] = p.z[i];
    r[3] = p.mass[i] / (k.density * (1 + p.density_change[i]));
    r[4] = p.vx[i], r[5] = p.vy[i], r[6] = p.vz[i];
    for (int c = 0; c < 6; ++c) r[8 + c] = p.stress[c][i];
  }
}

inline void sum_pairs(const ReferenceColumns& p, const ReferenceNumbers& k,
                      const ReferenceList& list) {
  const float *x = list.records, *y = x + 1, *z = x + 2, *volume = x + 3;
  const float *vx = x + 4, *vy = x + 5, *vz = x + 6;
  const float *sxx = x + 8, *syy = x + 9, *szz = x + 10, *sxy = x + 11, *syz = x + 12,
              *szx = x + 13;
  const int* offsets = list.offsets;
  const float to_s = 1 / (2 * k.h), eta2 = 0.01f * k.h * k.h;
  const float viscosity = k.viscosity * k.sound_speed * k.h * k.density;
  for (std::size_t i = 0; i < p.n; ++i) {
    const std::size_t self = record_floats * i;
    const float xi = x[self], yi = y[self], zi = z[self];
    const float vxi = vx[self], vyi = vy[self], vzi = vz[self];
    float lxx = 0, lxy = 0, lxz = 0, lyx = 0, lyy = 0, lyz = 0, lzx = 0, lzy = 0, lzz = 0;
    float gx = 0, gy = 0, gz = 0, ax = 0, ay = 0, az = 0;
#pragma omp simd reduction(+ : lxx, lxy, lxz, lyx, lyy, lyz, lzx, lzy, lzz, gx, gy, gz, ax, ay, az)
    for (int n = list.begin[i]; n < list.begin[i + 1]; ++n) {
      const int j = offsets[n];
      const float rx = xi - x[j], ry = yi - y[j], rz = zi - z[j];
      const float r2 = rx * rx + ry * ry + rz * rz;
      const float inside = 1 - sqrtf(r2) * to_s, t = inside > 0 ? inside : 0;
      const float w = t * t * t * volume[j];
      const float dx = w * rx, dy = w * ry, dz = w * rz;
      const float ux = vxi - vx[j], uy = vyi - vy[j], uz = vzi - vz[j];
      lxx += ux * dx, lxy += ux * dy, lxz += ux * dz;
      lyx += uy * dx, lyy += uy * dy, lyz += uy * dz;
      lzx += uz * dx, lzy += uz * dy, lzz += uz * dz;
      gx += dx, gy += dy, gz += dz;
      const float q = viscosity * (ux * rx + uy * ry + uz * rz) / (r2 + eta2);
      ax += (sxx[j] + q) * dx + sxy[j] * dy + szx[j] * dz;
      ay += sxy[j] * dx + (syy[j] + q) * dy + syz[j] * dz;
      az += szx[j] * dx + syz[j] * dy + (szz[j] + q) * dz;
    }
    const float factor = -k.gradient_factor / (k.density * (1 + p.density_change[i]));
    const float *xx = sxx + self, *yy = syy + self, *zz = szz + self;
    const float *xy = sxy + self, *yz = syz + self, *zx = szx + self;
    p.ax[i] = factor * (ax + *xx * gx + *xy * gy + *zx * gz);
    p.ay[i] = factor * (ay + *xy * gx + *yy * gy + *yz * gz);
    p.az[i] = factor * (az + *zx * gx + *yz * gy + *zz * gz);
    const float sums[9] = {lxx, lxy, lxz, lyx, lyy, lyz, lzx, lzy, lzz};
    for (int c = 0; c < 9; ++c) p.gradient[c][i] = k.gradient_factor * sums[c];
  }
}

inline void update_particles(const ReferenceColumns& p, const ReferenceNumbers& k, float dt) {
  float *x_x = p.stress[0], *y_y = p.stress[1], *z_z = p.stress[2];
  float *x_y = p.stress[3], *y_z = p.stress[4], *z_x = p.stress[5];
  const float *lxx = p.gradient[0], *lxy = p.gradient[1], *lxz = p.gradient[2];
  const float *lyx = p.gradient[3], *lyy = p.gradient[4], *lyz = p.gradient[5];
  const float *lzx = p.gradient[6], *lzy = p.gradient[7], *lzz = p.gradient[8];
  float* density_change = p.density_change;
  const float two_g = 2 * k.shear * dt;
#pragma omp simd
  for (std::size_t i = 0; i < p.n; ++i) {
    const float trace = lxx[i] + lyy[i] + lzz[i], e0 = density_change[i];
    const float e1 = e0 - dt * (1 + e0) * trace;
    const float p0 = e0 > 0 ? k.bulk * e0 : 0, p1 = e1 > 0 ? k.bulk * e1 : 0;
    density_change[i] = e1;
    const float a = x_x[i] + p0, b = y_y[i] + p0, c = z_z[i] + p0;
    const float d = x_y[i], e = y_z[i], f = z_x[i];
    // Spin times dt; s += w s - s w.
    const float wxy = 0.5f * dt * (lxy[i] - lyx[i]), wyz = 0.5f * dt * (lyz[i] - lzy[i]);
    const float wzx = 0.5f * dt * (lzx[i] - lxz[i]);
    const float third = trace / 3;
    float txx = a + 2 * (wxy * d - wzx * f) + two_g * (lxx[i] - third);
    float tyy = b + 2 * (wyz * e - wxy * d) + two_g * (lyy[i] - third);
    float tzz = c + 2 * (wzx * f - wyz * e) + two_g * (lzz[i] - third);
    float txy = d + wxy * (b - a) - wzx * e + wyz * f + 0.5f * two_g * (lxy[i] + lyx[i]);
    float tyz = e + wyz * (c - b) - wxy * f + wzx * d + 0.5f * two_g * (lyz[i] + lzy[i]);
    float tzx = f + wzx * (a - c) - wyz * d + wxy * e + 0.5f * two_g * (lzx[i] + lxz[i]);
    const float tau =
        sqrtf(0.5f * (txx * txx + tyy * tyy + tzz * tzz) + txy * txy + tyz * tyz + tzx * tzx);
    // The closed-form return of mu(I): smaller root of tau^2 - B tau + H.
    const float s0 = k.static_friction * p1, s2 = k.dynamic_friction * p1;
    const float slow = k.slowness * dt * sqrtf(p1);
    const float big = s2 + tau + slow, small = s2 * tau + s0 * slow;
    const float square = big * big - 4 * small;
    const float yielded = 2 * small / (big + sqrtf(square > 0 ? square : 0) + 1e-20f);
    const float scale = tau > s0 ? yielded / (tau + 1e-20f) : 1;
    x_x[i] = scale * txx - p1, y_y[i] = scale * tyy - p1, z_z[i] = scale * tzz - p1;
    x_y[i] = scale * txy, y_z[i] = scale * tyz, z_x[i] = scale * tzx;
  }
  for (std::size_t i = 0; i < p.n; ++i) {
    p.vx[i] += dt * p.ax[i];
    p.vy[i] += dt * p.ay[i];
    p.vz[i] += dt * (p.az[i] - k.gravity);
  }
}

inline void meet_ground(const ReferenceColumns& p, const ReferenceNumbers& k,
                        const ReferenceGround& g, float dt) {
  for (std::size_t i = 0; i < p.n; ++i) {
    const float u = (p.x[i] - g.west) / g.cell, v = (p.y[i] - g.south) / g.cell;
    if (!(u >= 0 && v >= 0 && u < g.n_cols - 1 && v < g.n_rows - 1)) continue;
    const int col = static_cast<int>(u), row = static_cast<int>(v);
    const float *south = g.z + static_cast<std::size_t>(row) * g.n_cols + col,
                *north = south + g.n_cols;
    const float a = u - col, b = v - row;
    const float z_s = south[0] + a * (south[1] - south[0]);
    const float z_n = north[0] + a * (north[1] - north[0]);
    const float height = p.z[i] - (z_s + b * (z_n - z_s));
    if (height > 2 * k.contact_distance) continue;
    const float east = ((1 - b) * (south[1] - south[0]) + b * (north[1] - north[0])) / g.cell;
    const float up = (z_n - z_s) / g.cell;
    const float nz = 1 / sqrtf(1 + east * east + up * up), nx = -east * nz, ny = -up * nz;
    const float overlap = k.contact_distance - height * nz;
    if (overlap <= 0) continue;
    const float vn = p.vx[i] * nx + p.vy[i] * ny + p.vz[i] * nz;
    const float push = k.spring * overlap - k.damping * vn;
    const float impulse = push > 0 ? push * dt : 0;
    const float tx = p.vx[i] - vn * nx, ty = p.vy[i] - vn * ny, tz = p.vz[i] - vn * nz;
    const float speed = sqrtf(tx * tx + ty * ty + tz * tz) + 1e-20f;
    const float cap = k.basal_friction * impulse / speed, keep = cap < 1 ? 1 - cap : 0;
    p.vx[i] = keep * tx + (vn + impulse) * nx;
    p.vy[i] = keep * ty + (vn + impulse) * ny;
    p.vz[i] = keep * tz + (vn + impulse) * nz;
  }
}

inline float drift(const ReferenceColumns& p, float dt) {
  float* const position[3] = {p.x, p.y, p.z};
  const float* const velocity[3] = {p.vx, p.vy, p.vz};
  float diagonal2 = 0;
  for (int c = 0; c < 3; ++c) {
    float lo = 1e30f, hi = -1e30f;
    for (std::size_t i = 0; i < p.n; ++i) {
      position[c][i] += dt * velocity[c][i];
      lo = velocity[c][i] < lo ? velocity[c][i] : lo;
      hi = velocity[c][i] > hi ? velocity[c][i] : hi;
    }
    diagonal2 += (hi - lo) * (hi - lo);
  }
  return sqrtf(diagonal2);
}

}  // namespace sturz::bench::STURZ_REFERENCE
