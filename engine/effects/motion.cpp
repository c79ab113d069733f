// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/parallel.hpp"

namespace sturz {
namespace {

struct MotionSums {
  double speed2 = 0, change2 = 0, kinetic = 0;
  double gravity_work = 0, stress_work = 0, impulse[3] = {0, 0, 0}, scale = 0;
  double lo[3] = {1e300, 1e300, 1e300}, hi[3] = {-1e300, -1e300, -1e300};
  double check = 0;  // becomes NaN or infinite when anything does
};

void combine(MotionSums& total, const MotionSums& block) {
  total.speed2 = std::max(total.speed2, block.speed2);
  total.change2 = std::max(total.change2, block.change2);
  total.kinetic += block.kinetic;
  total.gravity_work += block.gravity_work;
  total.stress_work += block.stress_work;
  total.scale += block.scale;
  for (int k = 0; k < 3; ++k) {
    total.impulse[k] += block.impulse[k];
    total.lo[k] = std::min(total.lo[k], block.lo[k]);
    total.hi[k] = std::max(total.hi[k], block.hi[k]);
  }
  total.check += block.check;
}

struct DriftSums {
  double risen = 0;           // sum of m dz
  double stopped_energy = 0;  // taken by a rim that is a wall
};

struct Velocity {
  double x, y, z;
};

/// At the start of the step, as the pack pass left it.
Velocity start_velocity(const ParticleSet& p, std::size_t i) {
  const Field* before = p.find_field("velocity_before");
  if (!before) return {p.vx[i], p.vy[i], p.vz[i]};
  return {before->component[0][i], before->component[1][i], before->component[2][i]};
}

class Motion final : public Pass {
 public:
  explicit Motion(const MotionSettings& m) : settings_(m) {}
  std::string_view name() const override { return "motion"; }
  Stage stage() const override { return Stage::move; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    const double none = std::numeric_limits<double>::infinity();
    const double v = s.motion.max_speed, a = s.motion.max_acceleration;
    out.push_back({"advection", v > 0 ? 0.25 * settings_.spacing / v : none});
    out.push_back({"force", a > 0 ? 0.25 * std::sqrt(settings_.smoothing_length / a) : none});
  }

  void apply(State& s, double dt) override {
    if (s.any_outside) remove_outside(s);
    drift(s, dt);
    refresh_motion(s, dt);
  }

 private:
  /// Particles found off the terrain at the start of the step are taken out, with the kinetic
  /// energy they had then: the works of this step are booked for those that stay.
  void remove_outside(State& s) {
    ParticleSet& p = s.grains;
    keep_.resize(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      keep_[i] = !s.leaves(i);
      if (keep_[i]) continue;
      const Velocity v = start_velocity(p, i);
      s.ledger.lost_mass += p.mass[i];
      s.ledger.lost_energy += 0.5 * p.mass[i] * (v.x * v.x + v.y * v.y + v.z * v.z);
    }
    for (auto* a : {&s.ax, &s.ay, &s.az}) {
      std::size_t n = 0;
      for (std::size_t i = 0; i < keep_.size(); ++i)
        if (keep_[i]) (*a)[n++] = (*a)[i];
      a->resize(n);
    }
    if (s.ax.size() == p.size()) return;
    p.compact(keep_);
    s.order_changed = true;
  }

  void drift(State& s, double dt) const {
    ParticleSet& p = s.grains;
    const bool rim = s.terrain.nodata_rule() == NodataRule::wall;
    const DriftSums sums = ordered_reduce(
        p.size(), s.threads, DriftSums{},
        [&](std::size_t begin, std::size_t end, DriftSums& out) {
          for (std::size_t i = begin; i < end; ++i) {
            if (rim) out.stopped_energy += p.mass[i] * stop_at_rim(s, i, dt);
            p.x[i] += dt * p.vx[i];
            p.y[i] += dt * p.vy[i];
            p.z[i] += dt * p.vz[i];
            out.risen += p.mass[i] * dt * p.vz[i];
          }
        },
        [](DriftSums& total, const DriftSums& block) {
          total.risen += block.risen;
          total.stopped_energy += block.stopped_energy;
        });
    s.ledger.potential += s.gravity * sums.risen;
    s.ledger.lost_energy += sums.stopped_energy;
  }

  /// A rim that is a wall takes the velocity component that would lead off the known ground.
  /// \return kinetic energy per mass that the rim took, with the mean velocity of the step [J/kg]
  static double stop_at_rim(State& s, std::size_t i, double dt) {
    ParticleSet& p = s.grains;
    const double vx = p.vx[i], vy = p.vy[i];
    auto known = [&](double ux, double uy) {
      double x = p.x[i] + dt * ux, y = p.y[i] + dt * uy, z = p.z[i];
      s.domain.wrap(x, y, z);
      return s.terrain.inside(x, y);
    };
    if (known(p.vx[i], p.vy[i])) return 0;
    if (known(p.vx[i], 0)) {
      p.vy[i] = 0;
    } else if (known(0, p.vy[i])) {
      p.vx[i] = 0;
    } else {
      p.vx[i] = p.vy[i] = 0;
    }
    const Velocity start = start_velocity(p, i);
    return 0.5 * ((vx - p.vx[i]) * (start.x + p.vx[i]) + (vy - p.vy[i]) * (start.y + p.vy[i]));
  }

  MotionSettings settings_;
  std::vector<std::uint8_t> keep_;
};

/// Works are taken with the mean velocity of the step: then a particle that is held at rest works
/// on nothing, and the sum of all works is the change of kinetic energy.
void book_step(const State& s, const Field& before, std::size_t i, double dt, MotionSums& out) {
  const ParticleSet& p = s.grains;
  const double bx = before.component[0][i], by = before.component[1][i],
               bz = before.component[2][i];
  const double dx = p.vx[i] - bx, dy = p.vy[i] - by, dz = p.vz[i] - bz;
  const double mx = bx + 0.5 * dx, my = by + 0.5 * dy, mz = bz + 0.5 * dz;
  const double m = p.mass[i] * dt, ax = s.ax[i], ay = s.ay[i], az = s.az[i];
  out.change2 = std::max(out.change2, dx * dx + dy * dy + dz * dz);
  out.gravity_work -= m * s.gravity * mz;
  out.stress_work += m * (ax * mx + ay * my + az * mz);
  out.impulse[0] += m * ax;
  out.impulse[1] += m * ay;
  out.impulse[2] += m * az;
  out.scale += m * std::sqrt(ax * ax + ay * ay + az * az);
}

}  // namespace

void refresh_motion(State& s, double dt) {
  const ParticleSet& p = s.grains;
  const Field* before = p.find_field("velocity_before");
  const MotionSums sums = ordered_reduce(
      p.size(), s.threads, MotionSums{},
      [&](std::size_t begin, std::size_t end, MotionSums& out) {
        for (std::size_t i = begin; i < end; ++i) {
          const double v[3] = {p.vx[i], p.vy[i], p.vz[i]};
          const double v2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
          out.speed2 = std::max(out.speed2, v2);
          out.kinetic += 0.5 * p.mass[i] * v2;
          out.check += v2 + p.x[i] + p.y[i] + p.z[i];
          for (int k = 0; k < 3; ++k) {
            out.lo[k] = std::min(out.lo[k], v[k]);
            out.hi[k] = std::max(out.hi[k], v[k]);
          }
          if (before && dt > 0) book_step(s, *before, i, dt, out);
        }
      },
      combine);
  s.motion.max_speed = std::sqrt(sums.speed2);
  s.motion.max_acceleration = dt > 0 ? std::sqrt(sums.change2) / dt : 0;
  for (int k = 0; k < 3; ++k)
    s.motion.velocity_range[k] = p.size() ? sums.hi[k] - sums.lo[k] : 0;
  s.motion.finite = std::isfinite(sums.check);
  Ledger& book = s.ledger;
  book.kinetic = sums.kinetic;
  book.gravity_work += sums.gravity_work;
  book.stress_work += sums.stress_work;
  for (int k = 0; k < 3; ++k) book.stress_impulse[k] += sums.impulse[k];
  book.stress_impulse_scale += sums.scale;
}

void add_motion(Step& step, State& state, const MotionSettings& settings) {
  (void)state;
  step.add(std::make_unique<Motion>(settings));
}

}  // namespace sturz
