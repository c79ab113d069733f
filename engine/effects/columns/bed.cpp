// SPDX-License-Identifier: Apache-2.0
// What gravity, lateral pressure and the bed do to a column.
#include "engine/core/parallel.hpp"
#include "engine/effects/columns/mixture.hpp"
#include "engine/effects/columns/shared.hpp"
#include "engine/effects/columns/wet_profile.hpp"
#include "engine/laws/braking.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

struct OnBed {
  double inside;  ///< what internal friction takes [m/s^2]
  double normal_gravity, thickness, density, gravity;
};

/// By a bed whose pore pressure is a constant share of the weight.
Vec3 slowed(const BasalResistance& bed, const OnBed& c, const Vec3& before, const Vec3& pull,
            double kick) {
  const auto plastic = [&](double v) {
    return bed.plastic(c.normal_gravity, c.thickness, c.density, v) + c.inside;
  };
  if (!bed.has_rate()) return braked(before, pull, plastic(0), 0, kick);
  // The bed at the mean speed of the step, found from the bed at its start: a steady flow keeps
  // its exact speed at any length of step.
  const auto rate = [&](double v) { return bed.rate(v, c.thickness, c.density, c.gravity); };
  const double v0 = before.norm();
  const double v1 = braked(before, pull, plastic(v0), rate(v0), kick).norm();
  const double mean = 0.5 * (v0 + v1);
  return braked(before, pull, plastic(mean), rate(mean), kick);
}

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
    const auto& thickness =
        flow_->bed_thickness.empty() ? p.scalar(fields::thickness) : flow_->bed_thickness;
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
    BasalResistance own;
    const BasalResistance& bed = flow_->bed_of(s.domain, p, i, own);
    OnBed on{0, normal_gravity, thickness, set.density, s.gravity};
    if (!set.spent_inside.empty() || set.spent_share > 0)
      on.inside = flow_->share[i] * flow_->spent_over(s.domain, p, i, bed) *
                  driving_thrust(p, i, n, pull, before, kick.time);
    const Vec3 after = slowed(bed, on, before, pull, kick.time);
    return moved(s, p, i, before, before + kick.time * pull, after, kick);
  }

  /// Works count from the start of the step, also where another set pushed since.
  Vec3 start_of_works(const MovingSet& p, std::size_t i, const Vec3& before) const {
    if (!flow_->has_exchange) return before;
    const auto& v = p.components(fields::velocity_before);
    return {v[0][i], v[1][i], v[2][i]};
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
    const Vec3 mean = 0.5 * (start_of_works(p, i, before) + after);
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
    BasalResistance own;
    for (std::size_t k = 0; k < b.n; ++k) {
      const BasalResistance& bed = flow_->bed_of(s.domain, p, first + k, own);
      b.friction[k] = bed.friction_coefficient, b.cohesion[k] = bed.cohesion_pa;
      b.drag[k] = bed.turbulent_coefficient > 0 ? s.gravity / bed.turbulent_coefficient : 0;
    }
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

void forecast(const State& s, MovingSet& p, const ColumnFlow& flow, double dt,
              ColumnForecast& out) {
  const double kick = kick_interval(s, dt);
  const GroundColumns ground(p);
  const auto& g_n = p.scalar(fields::normal_gravity);
  const auto& thickness =
      flow.bed_thickness.empty() ? p.scalar(fields::thickness) : flow.bed_thickness;
  for (auto* a : {&out.vx, &out.vy, &out.vz, &out.spare}) a->resize(p.size());
  parallel_ranges(p.size(), reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 before(p.vx[i], p.vy[i], p.vz[i]);
      const Velocity a = Velocity{p.ax[i], p.ay[i], p.az[i] - s.gravity}.in_plane(
          ground.component[0][i], ground.component[1][i]);
      const Vec3 pull(a.x, a.y, a.z);
      const BasalResistance& bed = flow.settings.bed[flow.zone_of(s.domain, p, i)];
      const double density = flow.settings.density;
      const double plastic = bed.plastic(g_n[i], thickness[i], density, before.norm());
      // Drag at the speed of the start: what is forecast here is what slip is judged by.
      const double rate =
          bed.has_rate() ? bed.rate(before.norm(), thickness[i], density, s.gravity) : 0;
      const Vec3 after = braked(before, pull, plastic, rate, kick);
      const bool held = plastic > 0 && after.x() == 0 && after.y() == 0 && after.z() == 0;
      out.vx[i] = after.x(), out.vy[i] = after.y(), out.vz[i] = after.z();
      out.spare[i] = held ? std::max(0.0, plastic * kick - (before + kick * pull).norm()) : 0;
    }
  });
}

void add_column_bed(Step& step, const std::shared_ptr<ColumnFlow>& flow) {
  step.add(std::make_unique<BedPass>(flow));
}

}  // namespace sturz
