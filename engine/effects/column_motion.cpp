// SPDX-License-Identifier: Apache-2.0
// What gravity, lateral pressure and the base do to a column, and where it goes.
#include <cmath>

#include "engine/core/parallel.hpp"
#include "engine/effects/terms/column_flow.hpp"
#include "engine/effects/terms/losses.hpp"
#include "engine/effects/terms/step_books.hpp"

namespace sturz {
namespace {

/// v_{n-1/2} -> v_{n+1/2} in the plane below each column; the base acts last and can stop it.
class BasePass final : public Pass {
 public:
  explicit BasePass(std::shared_ptr<ColumnFlow> flow) : flow_(std::move(flow)) {}
  std::string_view name() const override { return "gravity and base"; }
  Stage stage() const override { return Stage::contact; }

  void apply(State& s, double dt) override {
    const double kick = kick_length(s, dt);
    ParticleSet& p = s.grains;
    const GroundColumns ground(p);
    const auto& g_n = p.find_field("normal_gravity")->component[0];
    const auto& thickness = p.find_field("thickness")->component[0];
    const Works sums = ordered_reduce(
        p.size(), s.threads, Works{},
        [&](std::size_t begin, std::size_t end, Works& out) {
          for (std::size_t i = begin; i < end; ++i) {
            if (s.leaves(i)) continue;  // the books take it as it was at the start of the step
            const Works w = push(s, i, ground[i].normal(), g_n[i], thickness[i],
                                 kick, dt);
            out.friction += p.mass[i] * w.friction;
            out.contact += p.mass[i] * w.contact;
          }
        },
        [](Works& total, const Works& block) {
          total.friction += block.friction;
          total.contact += block.contact;
        });
    s.ledger.friction += sums.friction;
    s.ledger.contact_work += sums.contact;
  }

 private:
  struct Works {
    double friction = 0, contact = 0;  // taken by base and walls; done by walls [J/kg], [J]
  };

  /// \return works with the mean velocity of the step
  Works push(State& s, std::size_t i, const Vec3& n, double normal_gravity, double thickness,
             double kick, double drift) const {
    ParticleSet& p = s.grains;
    const Vec3 before(p.vx[i], p.vy[i], p.vz[i]);
    Vec3 pull(s.ax[i], s.ay[i], s.az[i] - s.gravity);
    pull -= pull.dot(n) * n;
    const DepthAveragedSettings& set = flow_->settings;
    const BasalResistance& base = set.base[flow_->zone_of(s, i)];
    const double plastic = base.plastic(normal_gravity, thickness, set.density);
    Vec3 after = braked(before, pull, plastic, 0, kick);
    if (base.has_rate()) {
      // The rate at the mean speed of the step, found from the rate at its start: a steady flow
      // keeps its exact speed at any length of step.
      auto rate = [&](double v) { return base.rate(v, thickness, set.density, s.gravity); };
      const double v0 = before.norm();
      const double v1 = braked(before, pull, plastic, rate(v0), kick).norm();
      after = braked(before, pull, plastic, rate(0.5 * (v0 + v1)), kick);
    }
    Vec3 taken = before + kick * pull - after, held(0, 0, 0);
    for (const Wall& wall : s.domain.walls) {
      if (s.time >= wall.remove_at_s) continue;
      const ColumnAtWall column = flow_->at_wall(p, i);
      const double pressed = kick * flow_->walls.pressure(s.domain, s.time, wall, column).norm();
      const auto impulse = flow_->walls.impulse(wall, column, after, pressed, drift);
      after += impulse.normal + impulse.friction;
      taken -= impulse.friction;
      held += impulse.normal;
    }
    p.vx[i] = after.x(), p.vy[i] = after.y(), p.vz[i] = after.z();
    const Vec3 mean = 0.5 * (before + after);
    return {taken.dot(mean), held.dot(mean)};
  }

  /// Exact solution of dv/dt = pull - plastic v/|v| - rate v with the direction frozen; the
  /// plastic part stops the column and never turns it.
  static Vec3 braked(const Vec3& v, const Vec3& pull, double plastic, double rate, double dt) {
    const double x = rate * dt, decay = std::exp(-x);
    const double mean = x > 1e-8 ? (1 - decay) / x : 1;
    const Vec3 trial = decay * v + (mean * dt) * pull;
    const double speed = trial.norm(), stop = plastic * mean * dt;
    return speed > stop ? Vec3((1 - stop / speed) * trial) : Vec3(0, 0, 0);
  }

  std::shared_ptr<ColumnFlow> flow_;
};

struct DriftSums {
  double risen = 0, stopped_energy = 0;  // sum of m dz; taken by a rim that is a wall
  double settled = 0;                    // what the kicks had left out of gravity's work
  double later = 0;                      // sum of m dz of the second half of the step
  bool any_outside = false;
};

class ColumnMotion final : public Pass {
 public:
  explicit ColumnMotion(std::shared_ptr<ColumnFlow> flow) : flow_(std::move(flow)) {}
  std::string_view name() const override { return "column motion"; }
  Stage stage() const override { return Stage::move; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    // Half a cell at this speed, also where gravity adds to it all the way.
    const double v = s.motion.max_speed, g = s.gravity, cell = s.terrain.grid().cell_m;
    out.push_back({"terrain cell", cell / (v + std::sqrt(v * v + g * cell))});
    // From rest with short steps that may grow: where the step changes fast, kicks and ways do not
    // fit together, and energy is lost or found.
    if (s.n_steps == 0) out.push_back({"start", flow_->start_dt});
  }

  void apply(State& s, double dt) override {
    if (s.any_outside) remove_outside(s, keep_);
    refresh_motion(s, kick_length(s, dt));
    drift(s, dt);
  }

 private:
  void drift(State& s, double dt) {
    ParticleSet& p = s.grains;
    const GroundColumns ground(p);
    s.outside.resize(p.size());
    const bool rim = s.terrain.nodata_rule() == NodataRule::wall;
    const DriftSums sums = ordered_reduce(
        p.size(), s.threads, DriftSums{},
        [&](std::size_t begin, std::size_t end, DriftSums& out) {
          for (std::size_t i = begin; i < end; ++i) {
            const double z = p.z[i], climb = p.vz[i];
            const ColumnGround mid = ground[i].ahead(0.5 * dt * p.vx[i], 0.5 * dt * p.vy[i]);
            turn_to(p, i, mid.normal());
            if (rim) out.stopped_energy += p.mass[i] * hold_at_rim(s, i, mid, dt);
            p.x[i] += dt * p.vx[i];
            p.y[i] += dt * p.vy[i];
            s.outside[i] = !look_up_ground(s, ground, i);
            turn_to(p, i, ground[i].normal());
            out.any_outside |= s.outside[i] != 0;
            const double counted = 0.5 * dt * (climb + p.vz[i]), rise = p.z[i] - z;
            out.settled += p.mass[i] * settle(p, i, s.gravity * (rise - counted));
            out.later += p.mass[i] * 0.5 * dt * p.vz[i];
            out.risen += p.mass[i] * rise;
          }
        },
        [](DriftSums& total, const DriftSums& block) {
          total.risen += block.risen;
          total.stopped_energy += block.stopped_energy;
          total.settled += block.settled;
          total.later += block.later;
          total.any_outside |= block.any_outside;
        });
    s.any_outside = sums.any_outside;
    // The next kick counts the second half of the way: until then the books leave it out too.
    s.ledger.potential += s.gravity * (later_rise_ + sums.risen - sums.later);
    later_rise_ = sums.later;
    s.ledger.lost_energy += sums.stopped_energy;
    s.ledger.gravity_work -= sums.settled;
    // Both were taken after the step's works were summed up.
    s.ledger.kinetic -= sums.stopped_energy + sums.settled;
  }

  /// \return kinetic energy that the rim took [J/kg]
  static double hold_at_rim(State& s, std::size_t i, const ColumnGround& ground, double dt) {
    ParticleSet& p = s.grains;
    const Vec3 v(p.vx[i], p.vy[i], p.vz[i]);
    stop_at_rim(s, i, dt);
    if (p.vx[i] == v.x() && p.vy[i] == v.y()) return 0;
    p.vz[i] = ground.east * p.vx[i] + ground.north * p.vy[i];
    return 0.5 * (v.squaredNorm() - Vec3(p.vx[i], p.vy[i], p.vz[i]).squaredNorm());
  }

  /// First to the slope at the middle of the step, which makes the way second order, then to that
  /// at its end.
  static void turn_to(ParticleSet& p, std::size_t i, const Vec3& normal) {
    const Vec3 v = turned_into_plane({p.vx[i], p.vy[i], p.vz[i]}, normal);
    p.vx[i] = v.x(), p.vy[i] = v.y(), p.vz[i] = v.z();
  }

  /// Kicks count gravity's work by the slopes at both ends of a step; over a kink or a cliff the
  /// ground fell or rose by something else. The speed pays the difference, so a column never has
  /// more energy than its fall gave it.
  /// \param missed  [J/kg]; \return what the speed could pay [J/kg]
  static double settle(ParticleSet& p, std::size_t i, double missed) {
    const double v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
    if (!(v2 > 0)) return 0;
    const double left = std::max(0.0, v2 - 2 * missed), factor = std::sqrt(left / v2);
    p.vx[i] *= factor, p.vy[i] *= factor, p.vz[i] *= factor;
    return 0.5 * (v2 - left);
  }

  std::shared_ptr<ColumnFlow> flow_;
  std::vector<std::uint8_t> keep_;
  double later_rise_ = 0;  // sum of m dz that the next kick counts [kg m]
};

}  // namespace

void add_column_motion(Step& step, const std::shared_ptr<ColumnFlow>& flow) {
  step.add(std::make_unique<BasePass>(flow));
  step.add(std::make_unique<ColumnMotion>(flow));
}

}  // namespace sturz
