// SPDX-License-Identifier: Apache-2.0
// The displacement of a column along the ground.
#include "engine/core/parallel.hpp"
#include "engine/effects/columns/shared.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "engine/effects/motion/losses.hpp"

#include <cmath>

namespace sturz {
namespace {

struct DriftSums {
  double risen = 0, stopped_energy = 0;  // sum of m dz; taken by a domain boundary that is a wall
  double projected = 0;                  // work of gravity that kicks left out
  double later = 0;                      // sum of m dz of the second half of the step
  bool any_leaving = false;
};

class ColumnMotion final : public Pass {
 public:
  explicit ColumnMotion(std::shared_ptr<ColumnFlow> flow) : flow_(std::move(flow)) {}
  std::string_view name() const override { return "column motion"; }
  std::string_view effect() const override { return EffectName::motion; }
  Stage stage() const override { return Stage::move; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    // Half a cell at this speed, also where gravity adds to it all the way.
    const double v = s.sets[flow_->set].motion.max_speed, g = s.gravity,
                 cell = s.terrain.grid().cell_m;
    out.push_back({"terrain cell", cell / (v + std::sqrt(v * v + g * cell))});
    // From rest with short steps that may grow: where the step changes fast, kicks and
    // displacements do not fit together, and energy is lost or found.
    if (s.n_steps == 0) out.push_back({"start", flow_->start_dt});
  }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[flow_->set];
    if (s.terrain.n_changes() != ground_changes_) follow_ground(s, p);
    if (p.any_leaving) remove_outside(s, p, keep_, dt);
    refresh_motion(s, p, kick_interval(s, dt));
    advance(s, p, dt);
  }
  /// The next kick counts half of the step before it for new columns too.
  void entered(State& s, std::size_t set, std::size_t first) override {
    if (set != flow_->set) return;
    const MovingSet& p = s.sets[set];
    for (std::size_t i = first; i < p.size(); ++i)
      later_rise_ += 0.5 * s.previous_dt * p.mass[i] * p.vz[i];
  }

 private:
  /// Ground that moved takes its columns along: their speed is not what pays for it.
  void follow_ground(const State& s, MovingSet& p) {
    ground_changes_ = s.terrain.n_changes();
    const GroundColumns ground(p);
    double lifted = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double z = p.z[i];
      look_up_ground(s, p, ground, i);
      lifted += p.mass[i] * s.gravity * (p.z[i] - z);
    }
    p.ledger.potential += lifted;
    p.ledger.outer_work += lifted;
  }

  /// In separate loops: the arithmetic four columns side by side, the look-ups one by one.
  void advance(const State& s, MovingSet& p, double dt) {
    const GroundColumns ground(p);
    p.fate.resize(p.size());
    climb_.resize(p.size());
    rise_.resize(p.size());
    const bool walled = s.terrain.nodata_rule() == NodataRule::wall;
    const DriftSums sums = ordered_reduce(
        p.size(), s.threads, DriftSums{},
        [&](std::size_t begin, std::size_t end, DriftSums& out) {
          turn_to_mid_step(p, ground, dt, begin, end);
          if (walled) hold_at_domain_boundary(s, p, ground, dt, begin, end, out);
          drift(s, p, ground, dt, begin, end, out);
          project(p, ground, s.gravity, dt, begin, end, out);
        },
        [](DriftSums& total, const DriftSums& block) {
          total.risen += block.risen;
          total.stopped_energy += block.stopped_energy;
          total.projected += block.projected;
          total.later += block.later;
          total.any_leaving |= block.any_leaving;
        });
    p.any_leaving = sums.any_leaving;
    // The next kick counts the second half of the displacement: until then the ledger leaves it out
    // too.
    p.ledger.potential += s.gravity * (later_rise_ + sums.risen - sums.later);
    later_rise_ = sums.later;
    p.ledger.lost_energy += sums.stopped_energy;
    p.ledger.gravity_work -= sums.projected;
    // Both were taken after the step's works were summed up.
    p.ledger.kinetic -= sums.stopped_energy + sums.projected;
  }

  /// The slopes at the middle of the step make the displacement second order.
  void turn_to_mid_step(ParticleSet& p, const GroundColumns& ground, double dt, std::size_t begin,
                        std::size_t end) {
    const double *east = ground.component[0], *north = ground.component[1];
    const double *ee = ground.component[2], *en = ground.component[3], *nn = ground.component[4];
    double *vx = p.vx.data(), *vy = p.vy.data(), *vz = p.vz.data(), *climb = climb_.data();
    const double half = 0.5 * dt;
#pragma omp simd
    for (std::size_t i = begin; i < end; ++i) {
      const Velocity v{vx[i], vy[i], vz[i]};
      climb[i] = v.z;
      const double x = half * v.x, y = half * v.y;
      const Velocity mid =
          v.turned(east[i] + ee[i] * x + en[i] * y, north[i] + en[i] * x + nn[i] * y);
      vx[i] = mid.x, vy[i] = mid.y, vz[i] = mid.z;
    }
  }

  /// Takes the velocity that would lead off the known ground.
  void hold_at_domain_boundary(const State& s, MovingSet& p, const GroundColumns& ground, double dt,
                               std::size_t begin, std::size_t end, DriftSums& out) const {
    for (std::size_t i = begin; i < end; ++i) {
      const Velocity v{p.vx[i], p.vy[i], p.vz[i]};
      stop_at_domain_boundary(s, p, i, dt);
      if (p.vx[i] == v.x && p.vy[i] == v.y) continue;
      const ColumnGround mid = ground[i].ahead(0.5 * dt * v.x, 0.5 * dt * v.y);
      p.vz[i] = mid.east * p.vx[i] + mid.north * p.vy[i];
      out.stopped_energy +=
          0.5 * p.mass[i] * (v.norm2() - Velocity{p.vx[i], p.vy[i], p.vz[i]}.norm2());
    }
  }

  void drift(const State& s, MovingSet& p, const GroundColumns& ground, double dt,
             std::size_t begin, std::size_t end, DriftSums& out) {
    for (std::size_t i = begin; i < end; ++i) {
      const double z = p.z[i];
      p.x[i] += dt * p.vx[i];
      p.y[i] += dt * p.vy[i];
      const bool known = look_up_ground(s, p, ground, i);
      p.fate[i] = known ? Fate::stays : Fate::off_terrain;
      out.any_leaving |= !known;
      rise_[i] = p.z[i] - z;
    }
  }

  /// Turns to the slopes at the end of the step. Kicks count gravity's work by the slopes at both
  /// ends of a step; over a kink or a cliff the ground fell or rose by something else. The speed
  /// pays the difference, so a column never has more energy than its fall gave it.
  void project(ParticleSet& p, const GroundColumns& ground, double gravity, double dt,
               std::size_t begin, std::size_t end, DriftSums& out) const {
    const double *east = ground.component[0], *north = ground.component[1];
    const double *climb = climb_.data(), *rise = rise_.data(), *mass = p.mass.data();
    double *vx = p.vx.data(), *vy = p.vy.data(), *vz = p.vz.data();
    double projected = 0, later = 0, risen = 0;
    const double half = 0.5 * dt;
#pragma omp simd reduction(+ : projected, later, risen)
    for (std::size_t i = begin; i < end; ++i) {
      const Velocity v = Velocity{vx[i], vy[i], vz[i]}.turned(east[i], north[i]);
      const double v2 = v.norm2(), missed = gravity * (rise[i] - half * (climb[i] + v.z));
      const double paid = v2 - 2 * missed, left = v2 > 0 && paid > 0 ? paid : 0;
      const double share = v2 > 0 ? left / v2 : 0, factor = std::sqrt(share);
      vx[i] = v.x * factor, vy[i] = v.y * factor, vz[i] = v.z * factor;
      projected += 0.5 * mass[i] * (v2 - left);
      later += mass[i] * half * vz[i];
      risen += mass[i] * rise[i];
    }
    out.projected += projected;
    out.later += later;
    out.risen += risen;
  }

  std::shared_ptr<ColumnFlow> flow_;
  std::vector<std::uint8_t> keep_;
  std::vector<double> climb_, rise_;  // of each column: v_z at the step's start [m/s], dz [m]
  std::size_t ground_changes_ = 0;    // that the columns stand on
  double later_rise_ = 0;             // sum of m dz that the next kick counts [kg m]
};

}  // namespace

void add_column_motion(Step& step, const std::shared_ptr<ColumnFlow>& flow) {
  step.add(std::make_unique<ColumnMotion>(flow));
}

}  // namespace sturz
