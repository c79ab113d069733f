// SPDX-License-Identifier: Apache-2.0
// What gravity, lateral pressure and the bed do to a column.
#include "engine/core/parallel.hpp"
#include "engine/effects/columns/braking.hpp"
#include "engine/effects/columns/mixture.hpp"
#include "engine/effects/columns/shared.hpp"
#include "engine/effects/columns/wet_profile.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// v_{n-1/2} -> v_{n+1/2} in the plane below each column; the bed acts last and can stop it.
class BedPass final : public Pass {
 public:
  explicit BedPass(std::shared_ptr<ColumnFlow> flow) : flow_(std::move(flow)) {}
  std::string_view name() const override { return "gravity and bed"; }
  std::string_view effect() const override { return EffectName::bed; }
  Stage stage() const override { return Stage::contact; }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[flow_->set];
    const GroundColumns ground(p);
    const Kick kick{kick_interval(s, dt), dt};
    const Works sums =
        flow_->settings.mixture ? push_wet(s, p, ground, kick) : push_dry(s, p, ground, kick);
    p.ledger.friction += sums.friction;
    p.ledger.contact_work += sums.contact;
    p.ledger.clipped_work += sums.clipped;
  }

 private:
  struct Kick {
    double time, drift;  // of the kick; of the displacement after it [s]
  };
  struct Works {
    double friction = 0, contact = 0;  // taken by bed and walls; done by walls [J/kg], [J]
    double clipped = 0;                // of pore pressures beyond their bounds [J]
  };
  template <class Body>
  static Works summed(const State& s, const MovingSet& p, Body&& body) {
    return ordered_reduce(p.size(), s.threads, Works{}, body, [](Works& total, const Works& block) {
      total.friction += block.friction;
      total.contact += block.contact;
      total.clipped += block.clipped;
    });
  }

  Works push_dry(const State& s, MovingSet& p, const GroundColumns& ground,
                 const Kick& kick) const {
    const auto& g_n = p.scalar(fields::normal_gravity);
    const auto& thickness = p.scalar(fields::thickness);
    return summed(s, p, [&](std::size_t begin, std::size_t end, Works& out) {
      for (std::size_t i = begin; i < end; ++i) {
        if (s.leaves(p, i)) continue;  // the ledger takes it as it was at the start of the step
        const Works w = push(s, p, i, ground[i].normal(), g_n[i], thickness[i], kick);
        out.friction += p.mass[i] * w.friction;
        out.contact += p.mass[i] * w.contact;
      }
    });
  }

  /// \return works with the mean velocity of the step
  Works push(const State& s, MovingSet& p, std::size_t i, const Vec3& n, double normal_gravity,
             double thickness, const Kick& kick) const {
    const Vec3 before(p.vx[i], p.vy[i], p.vz[i]);
    Vec3 pull(p.ax[i], p.ay[i], p.az[i] - s.gravity);
    pull -= pull.dot(n) * n;
    const DepthAveragedSettings& set = flow_->settings;
    const int zone = flow_->zone_of(s.domain, p, i);
    const BasalResistance& bed = set.bed[zone];
    double plastic = bed.plastic(normal_gravity, thickness, set.density);
    if (!set.spent_inside.empty())
      plastic += flow_->share[i] * set.spent_inside[zone] *
                 driving_thrust(p, i, n, pull, before, kick.time);
    const Vec3 after =
        slowed(bed, {plastic, thickness, set.density, s.gravity}, before, pull, kick.time);
    return moved(s, p, i, before, before + kick.time * pull, after, kick);
  }

  /// Gives column i its velocity behind bed and walls.
  Works moved(const State& s, MovingSet& p, std::size_t i, const Vec3& before, const Vec3& free,
              Vec3 after, const Kick& kick) const {
    Vec3 taken = free - after, held(0, 0, 0);
    for (const Wall& wall : s.domain.walls) {
      if (s.time >= wall.remove_at_s) continue;
      const ColumnAtWall column = flow_->at_wall(p, i);
      const double pressed =
          kick.time * flow_->walls.pressure(s.domain, s.time, wall, column).norm();
      const auto impulse = flow_->walls.impulse(wall, column, after, pressed, kick.drift);
      after += impulse.normal + impulse.friction;
      taken -= impulse.friction;
      held += impulse.normal;
    }
    p.vx[i] = after.x(), p.vy[i] = after.y(), p.vz[i] = after.z();
    const Vec3 mean = 0.5 * (before + after);
    return {taken.dot(mean), held.dot(mean)};
  }

  Works push_wet(const State& s, MovingSet& p, const GroundColumns& ground,
                 const Kick& kick) const {
    const WetBed bed(p, *flow_->settings.mixture, flow_->strain_rate);
    return summed(s, p, [&](std::size_t begin, std::size_t end, Works& out) {
      WetBlock block;
      WetProfile profile(flow_->settings.mixture->profile);
      block.time = kick.time;
      if (profile.mesh.nodes > 0) block.profile = &profile;
      for (std::size_t first = begin; first < end; first += block.n) {
        block.n = std::min(WetBlock::capacity, end - first);
        bed.read(block, first);
        pull(s, p, ground, first, block);
        lay_bed(s, p, first, block);
        bed.slide(block);
        for (std::size_t k = 0; k < block.n; ++k) {
          const std::size_t i = first + k;
          if (s.leaves(p, i)) continue;
          bed.keep(block, k, i);
          const Vec3 before(p.vx[i], p.vy[i], p.vz[i]);
          const Vec3 free =
              before + kick.time * Vec3(block.pull_x[k], block.pull_y[k], block.pull_z[k]);
          const Works w =
              moved(s, p, i, before, free, Vec3(block.vx[k], block.vy[k], block.vz[k]), kick);
          out.friction += p.mass[i] * w.friction;
          out.contact += p.mass[i] * w.contact;
          out.clipped += block.clipped_work[k];
        }
      }
    });
  }

  /// Velocities and tangent accelerations without the bed.
  static void pull(const State& s, const MovingSet& p, const GroundColumns& ground,
                   std::size_t first, WetBlock& b) {
    const double *east = ground.component[0] + first, *north = ground.component[1] + first;
    const double *vx = p.vx.data() + first, *vy = p.vy.data() + first, *vz = p.vz.data() + first;
    const float *ax = p.ax.data() + first, *ay = p.ay.data() + first, *az = p.az.data() + first;
    const double gravity = s.gravity;
#pragma omp simd
    for (std::size_t k = 0; k < b.n; ++k) {
      b.vx[k] = vx[k], b.vy[k] = vy[k], b.vz[k] = vz[k];
      const Velocity a = Velocity{ax[k], ay[k], az[k] - gravity}.in_plane(east[k], north[k]);
      b.pull_x[k] = a.x, b.pull_y[k] = a.y, b.pull_z[k] = a.z;
    }
  }

  void lay_bed(const State& s, const MovingSet& p, std::size_t first, WetBlock& b) const {
    const auto& beds = flow_->settings.bed;
    for (std::size_t k = 0; k < b.n; ++k) {
      const BasalResistance& bed =
          beds.size() == 1 ? beds[0] : beds[flow_->zone_of(s.domain, p, first + k)];
      b.friction[k] = bed.friction_coefficient, b.cohesion[k] = bed.cohesion_pa;
      b.drag[k] = bed.turbulent_coefficient > 0 ? s.gravity / bed.turbulent_coefficient : 0;
    }
  }

  struct OnBed {
    double plastic, thickness, density, gravity;
  };
  /// By a bed whose pore pressure is a constant share of the weight.
  static Vec3 slowed(const BasalResistance& bed, const OnBed& c, const Vec3& before,
                     const Vec3& pull, double kick) {
    if (!bed.has_rate()) return braked(before, pull, c.plastic, 0, kick);
    // The rate at the mean speed of the step, found from the rate at its start: a steady flow
    // keeps its exact speed at any length of step.
    auto rate = [&](double v) { return bed.rate(v, c.thickness, c.density, c.gravity); };
    const double v0 = before.norm();
    const double v1 = braked(before, pull, c.plastic, rate(v0), kick).norm();
    return braked(before, pull, c.plastic, rate(0.5 * (v0 + v1)), kick);
  }

  /// What pressure adds to the motion that it drives, or would start [m/s^2]; what it takes to hold
  /// the column against the fall of the ground drives nothing.
  static double driving_thrust(const MovingSet& p, std::size_t i, const Vec3& n, const Vec3& pull,
                               const Vec3& before, double kick) {
    Vec3 thrust(p.ax[i], p.ay[i], p.az[i]);
    thrust -= thrust.dot(n) * n;
    const Vec3 along = before + kick * pull;
    const double speed = along.norm();
    if (!(speed > 0)) return 0;
    return std::max(0.0, std::min(thrust.dot(along), pull.dot(along)) / speed);
  }

  std::shared_ptr<ColumnFlow> flow_;
};

}  // namespace

void add_column_bed(Step& step, const std::shared_ptr<ColumnFlow>& flow) {
  step.add(std::make_unique<BedPass>(flow));
}

}  // namespace sturz
