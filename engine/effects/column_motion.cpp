// SPDX-License-Identifier: Apache-2.0
// What gravity, lateral pressure and the base do to a column, and where it goes.
#include <cmath>
#include <limits>

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
    const ParticleSet& p = s.grains;
    const Field& ground = *p.find_field("ground");
    const auto& g_n = p.find_field("normal_gravity")->component[0];
    const auto& thickness = p.find_field("thickness")->component[0];
    const Works sums = ordered_reduce(
        p.size(), s.threads, Works{},
        [&](std::size_t begin, std::size_t end, Works& out) {
          for (std::size_t i = begin; i < end; ++i) {
            const Works w = push(s, i, ColumnGround::of(ground, i).normal(), g_n[i], thickness[i],
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
  bool any_outside = false;
};

class ColumnMotion final : public Pass {
 public:
  explicit ColumnMotion(std::shared_ptr<ColumnFlow> flow) : flow_(std::move(flow)) {}
  std::string_view name() const override { return "column motion"; }
  Stage stage() const override { return Stage::move; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    const double v = s.motion.max_speed;
    out.push_back({"terrain cell", v > 0 ? 0.5 * s.terrain.grid().cell_m / v
                                         : std::numeric_limits<double>::infinity()});
  }

  void apply(State& s, double dt) override {
    if (s.any_outside) remove_outside(s, keep_);
    refresh_motion(s, kick_length(s, dt));
    drift(s, dt);
  }

 private:
  void drift(State& s, double dt) {
    ParticleSet& p = s.grains;
    Field& ground = *p.find_field("ground");
    s.outside.resize(p.size());
    const bool rim = s.terrain.nodata_rule() == NodataRule::wall;
    const DriftSums sums = ordered_reduce(
        p.size(), s.threads, DriftSums{},
        [&](std::size_t begin, std::size_t end, DriftSums& out) {
          for (std::size_t i = begin; i < end; ++i) {
            turn_to_mid_step(p, ground, i, dt);
            if (rim) out.stopped_energy += p.mass[i] * stop_at_rim(s, i, dt);
            const double z = p.z[i];
            p.x[i] += dt * p.vx[i];
            p.y[i] += dt * p.vy[i];
            s.outside[i] = !look_up_ground(s, ground, i);
            out.any_outside |= s.outside[i] != 0;
            out.risen += p.mass[i] * (p.z[i] - z);
          }
        },
        [](DriftSums& total, const DriftSums& block) {
          total.risen += block.risen;
          total.stopped_energy += block.stopped_energy;
          total.any_outside |= block.any_outside;
        });
    s.any_outside = sums.any_outside;
    // Velocities, and so all works, stand at the middle of the step: the books do too.
    const double risen = s.gravity * sums.risen;
    s.ledger.potential += later_potential_ + 0.5 * risen;
    later_potential_ = 0.5 * risen;
    s.ledger.lost_energy += sums.stopped_energy;
  }

  /// The way is that of the middle of the step: second order, and energy is kept over bends.
  static void turn_to_mid_step(ParticleSet& p, const Field& ground, std::size_t i, double dt) {
    const ColumnGround here = ColumnGround::of(ground, i);
    const Vec3 mid = here.ahead(0.5 * dt * p.vx[i], 0.5 * dt * p.vy[i]).normal();
    const Vec3 v = turned_into_plane({p.vx[i], p.vy[i], p.vz[i]}, mid);
    p.vx[i] = v.x(), p.vy[i] = v.y(), p.vz[i] = v.z();
  }

  std::shared_ptr<ColumnFlow> flow_;
  std::vector<std::uint8_t> keep_;
  double later_potential_ = 0;  // of the step's second half [J]
};

}  // namespace

void add_column_motion(Step& step, const std::shared_ptr<ColumnFlow>& flow) {
  step.add(std::make_unique<BasePass>(flow));
  step.add(std::make_unique<ColumnMotion>(flow));
}

}  // namespace sturz
