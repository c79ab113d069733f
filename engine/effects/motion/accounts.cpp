// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/motion/accounts.hpp"

#include "engine/core/parallel.hpp"
#include "engine/effects/fields.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

struct MotionSums {
  double speed2 = 0, change2 = 0, kinetic = 0;
  double gravity_work = 0, stress_work = 0, scale = 0;
  Vec3 impulse{0, 0, 0};
  Eigen::Array3d lo{1e300, 1e300, 1e300}, hi{-1e300, -1e300, -1e300};
  double check = 0;  // becomes NaN or infinite when anything does
};

void combine(MotionSums& total, const MotionSums& block) {
  total.speed2 = std::max(total.speed2, block.speed2);
  total.change2 = std::max(total.change2, block.change2);
  total.kinetic += block.kinetic;
  total.gravity_work += block.gravity_work;
  total.stress_work += block.stress_work;
  total.scale += block.scale;
  total.impulse += block.impulse;
  total.lo = total.lo.min(block.lo);
  total.hi = total.hi.max(block.hi);
  total.check += block.check;
}

/// Works are taken with the mean velocity of the step: then a particle that is held at rest works
/// on nothing, and the sum of all works is the change of kinetic energy.
void account_step(const MovingSet& p, double gravity, const double* const before[3], std::size_t i,
                  double dt, MotionSums& out) {
  const double bx = before[0][i], by = before[1][i], bz = before[2][i];
  const double dx = p.vx[i] - bx, dy = p.vy[i] - by, dz = p.vz[i] - bz;
  const double mx = bx + 0.5 * dx, my = by + 0.5 * dy, mz = bz + 0.5 * dz;
  const double m = p.mass[i] * dt, ax = p.ax[i], ay = p.ay[i], az = p.az[i];
  out.change2 = std::max(out.change2, dx * dx + dy * dy + dz * dz);
  out.gravity_work -= m * gravity * mz;
  out.stress_work += m * (ax * mx + ay * my + az * mz);
  out.impulse += m * Vec3(ax, ay, az);
  out.scale += m * std::sqrt(ax * ax + ay * ay + az * az);
}

}  // namespace

void refresh_motion(const State& s, MovingSet& p, double dt) {
  const Field* field = p.find(fields::velocity_before);
  const double* before[3] = {};
  for (int k = 0; field && k < 3; ++k) before[k] = field->component[k].data();
  const MotionSums sums = ordered_reduce(
      p.size(), s.threads, MotionSums{},
      [&](std::size_t begin, std::size_t end, MotionSums& out) {
        for (std::size_t i = begin; i < end; ++i) {
          const double vx = p.vx[i], vy = p.vy[i], vz = p.vz[i];
          // Written out: Eigen adds three squares in another order, and bits must stay.
          const double v2 = vx * vx + vy * vy + vz * vz;
          out.speed2 = std::max(out.speed2, v2);
          out.kinetic += 0.5 * p.mass[i] * v2;
          out.check += v2 + p.x[i] + p.y[i] + p.z[i];
          const Eigen::Array3d v(vx, vy, vz);
          out.lo = out.lo.min(v);
          out.hi = out.hi.max(v);
          if (field && dt > 0) account_step(p, s.gravity, before, i, dt, out);
        }
      },
      combine);
  p.motion.max_speed = std::sqrt(sums.speed2);
  p.motion.max_acceleration = dt > 0 ? std::sqrt(sums.change2) / dt : 0;
  for (int k = 0; k < 3; ++k) p.motion.velocity_range[k] = p.size() ? sums.hi[k] - sums.lo[k] : 0;
  p.motion.finite = std::isfinite(sums.check) && !p.corrupt;
  Ledger& ledger = p.ledger;
  ledger.kinetic = sums.kinetic;
  ledger.gravity_work += sums.gravity_work;
  ledger.stress_work += sums.stress_work;
  ledger.stress_impulse += sums.impulse;
  ledger.stress_impulse_scale += sums.scale;
}

}  // namespace sturz
