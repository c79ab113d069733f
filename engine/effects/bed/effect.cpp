// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/bed/effect.hpp"

#include "engine/core/parallel.hpp"
#include "engine/effects/bed/contact_sums.hpp"
#include "engine/effects/bed/liquid_contact.hpp"
#include "engine/effects/bed/mirrored.hpp"
#include "engine/effects/fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sturz {
namespace {

/// Looks up the ground under every particle and what the mirrored halves add to its gradients.
class BoundaryPass final : public Pass {
 public:
  BoundaryPass(std::size_t set, ContactSettings c) : set_(set), settings_(std::move(c)) {}
  std::string_view name() const override { return "ground and wall support"; }
  std::string_view effect() const override { return EffectName::bed; }
  Stage stage() const override { return Stage::boundary; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    const double v = s.sets[set_].motion.max_speed, cell = s.terrain.grid().cell_m;
    out.push_back(
        {"terrain cell", v > 0 ? 0.5 * cell / v : std::numeric_limits<double>::infinity()});
  }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[set_];
    make_room(s.domain, p);
    p.boundary.no_slip = settings_.liquid && settings_.liquid->bed == LiquidBed::no_slip;
    // Where nothing moved in storage, what was far from the ground has come no nearer than it went.
    const bool known = p.n_sorts == sorts_ && p.size() == n_ && p.n_created() == created_ &&
                       s.terrain.n_changes() == ground_changes_;
    ground_changes_ = s.terrain.n_changes();
    sorts_ = p.n_sorts;
    created_ = p.n_created();
    n_ = p.size();
    const auto travel = static_cast<float>(1.0001 * p.motion.max_speed * s.previous_dt);
    const auto far = static_cast<float>(2 * settings_.smoothing_length);
    float* distance = p.boundary.distance.data();
    const Found found = ordered_reduce(
        n_, s.threads, Found{},
        [&](std::size_t begin, std::size_t end, Found& out) {
          for (std::size_t i = begin; i < end; ++i) {
            if (known && distance[i] - travel > far)
              distance[i] -= travel;
            else
              locate(s, p, i, out);
          }
          if (!s.domain.walls.empty() && !p.boundary.mirrored_walls)
            add_walls(s, p, dt, begin, end);
        },
        [](Found& total, const Found& block) {
          total.any_leaving |= block.any_leaving;
          total.leaked += block.leaked;
        });
    p.any_leaving = found.any_leaving;
    p.ledger.leaked_mass += found.leaked;
  }

 private:
  struct Found {
    bool any_leaving = false;
    double leaked = 0;
  };

  /// Whole groups, because the sweep reads lanes.
  static void make_room(const Domain& domain, MovingSet& p) {
    const std::size_t padded = (p.size() + 15) / 16 * 16;
    BoundarySupport& b = p.boundary;
    for (auto* column : {&b.distance, &b.nx, &b.ny, &b.nz}) column->resize(padded);
    p.fate.resize(p.size());
    if (domain.walls.empty() || b.mirrored_walls) return;
    for (int c = 0; c < 6; ++c) b.moment[c].resize(padded), b.gradient[c].resize(padded);
  }

  void locate(const State& s, MovingSet& p, std::size_t i, Found& out) const {
    BoundarySupport& b = p.boundary;
    Vec3 at(p.x[i], p.y[i], p.z[i]);
    s.domain.wrap(at.x(), at.y(), at.z());
    SurfaceDistance gap;
    const bool known = s.terrain.distance_inside(at, 0.5 * settings_.spacing, gap);
    p.fate[i] = known ? Fate::stays : Fate::off_terrain;
    b.distance[i] = static_cast<float>(gap.distance);
    b.nx[i] = static_cast<float>(gap.normal.x());
    b.ny[i] = static_cast<float>(gap.normal.y());
    b.nz[i] = static_cast<float>(gap.normal.z());
    const double support_radius = 2 * settings_.smoothing_length;
    if (gap.distance > support_radius)  // how long it need not be looked at again
      b.distance[i] = static_cast<float>(std::fmax(support_radius, s.terrain.clearance(at)));
    if (gap.distance < -2 * settings_.spacing) {  // lost underground: accounted for, never repaired
      p.fate[i] = Fate::underground;
      out.leaked += p.mass[i];
    }
    out.any_leaving |= p.fate[i] != Fate::stays;
  }

  /// What the mirrored halves beside analytic walls add to moment and gradient of [begin, end).
  void add_walls(const State& s, MovingSet& p, double dt, std::size_t begin,
                 std::size_t end) const {
    BoundarySupport& b = p.boundary;
    const Field* before = p.find(fields::velocity_before);
    if (!before) return;  // no effect sums gradients
    const double ahead = s.extrapolation(dt);
    for (int c = 0; c < 6; ++c) {
      std::fill(b.moment[c].begin() + begin, b.moment[c].begin() + end, 0.0f);
      std::fill(b.gradient[c].begin() + begin, b.gradient[c].begin() + end, 0.0f);
    }
    for (const Wall& wall : s.domain.walls) {
      if (s.time >= wall.remove_at_s) continue;
      const Vec3& n = wall.normal;
      const double nn[6] = {n.x() * n.x(), n.y() * n.y(), n.z() * n.z(),
                            n.x() * n.y(), n.y() * n.z(), n.z() * n.x()};
      for (std::size_t i = begin; i < end; ++i) {
        const double d = (Vec3(p.x[i], p.y[i], p.z[i]) - wall.point).dot(n);
        const double plane = plane_integral(d, settings_.smoothing_length);
        if (plane <= 0) continue;
        const Vec3 v(p.vx[i], p.vy[i], p.vz[i]);
        const Vec3 last(before->component[0][i], before->component[1][i], before->component[2][i]);
        const double moment = 2 * plane * std::fmax(0.0, d);
        const double gradient = 2 * plane * (v + ahead * (v - last)).dot(n);
        for (int c = 0; c < 6; ++c) {
          b.moment[c][i] += static_cast<float>(moment * nn[c]);
          b.gradient[c][i] += static_cast<float>(gradient * nn[c]);
        }
      }
    }
  }

  std::size_t set_;
  ContactSettings settings_;
  std::size_t sorts_ = 0, n_ = 0, created_ = 0, ground_changes_ = 0;  // of the step before
};

class GroundContact final : public Pass {
 public:
  GroundContact(std::size_t set, const ContactSettings& c) : set_(set), settings_(c) {
    for (const GroundFriction& zone : c.bed) {
      laws_.push_back(smooth_contact(c));
      lay(laws_.back(), zone);
    }
  }
  std::string_view name() const override { return "terrain contact"; }
  std::string_view effect() const override { return EffectName::bed; }
  Stage stage() const override { return Stage::contact; }

  void limits(const State&, std::vector<StepLimit>& out) const override {
    out.push_back({"terrain spring", 0.2 / std::sqrt(settings_.stiffness)});
  }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[set_];
    const WallPressure pressure = WallPressure::of_ground(p, settings_);
    const ContactSums sums = ordered_reduce(
        p.size(), s.threads, ContactSums{},
        [&](std::size_t begin, std::size_t end, ContactSums& out) {
          press(s, p, pressure, dt, begin, end, out);
        },
        combine);
    account_ground(s.domain, p, sums);
  }

 private:
  void press(const State& s, MovingSet& p, const WallPressure& collisions, double dt,
             std::size_t begin, std::size_t end, ContactSums& out) const {
    const BoundarySupport& b = p.boundary;
    const StartVelocity start(p);
    const GroundImages images(p);
    const HandedOn handed_on(p, settings_);
    // As the sweep has it: distances beyond are that number itself, and the images' push is stale
    // there.
    const auto support_radius = static_cast<float>(2 * settings_.smoothing_length);
    const bool zoned = settings_.zones.any(), rastered = settings_.rasters.any();
    const bool walled = !s.domain.walls.empty() && p.has(fields::velocity_before);
    for (std::size_t i = begin; i < end; ++i) {
      if (p.fate[i] != Fate::stays || b.distance[i] >= support_radius) continue;
      const Vec3 n(b.nx[i], b.ny[i], b.nz[i]), push = images(i);
      double support = std::fmax(0.0, push.dot(n));
      out.along += p.mass[i] * dt * (push - push.dot(n) * n);
      out.pushed += p.mass[i] * dt * push.norm();
      if (collisions.acts())
        support += collisions.acceleration(
            i, plane_integral(b.distance[i], settings_.smoothing_length), n.x(), n.y(), n.z());
      const std::size_t zone = zoned ? zone_of(s.domain, p, i) : 0;
      ContactLaw law = rastered ? law_at(s.domain, p, i, zone) : laws_[zone];
      law.friction = handed_on(i, b.distance[i], law.friction);
      const Vec3 before = start(i), found(p.vx[i], p.vy[i], p.vz[i]);
      out.add(apply_contact(law, b.distance[i], n.x(), n.y(), n.z(), support, dt, before.data(),
                            p.vx[i], p.vy[i], p.vz[i]),
              p.mass[i]);
      if (walled)
        out.contact_work +=
            0.5 * p.mass[i] *
            by_walls(s, p, i, found - before, dt).dot(Vec3(p.vx[i], p.vy[i], p.vz[i]) - found);
    }
  }

  std::size_t zone_of(const Domain& domain, const ParticleSet& p, std::size_t i) const {
    double x = p.x[i], y = p.y[i], z = 0;
    domain.wrap(x, y, z);
    return static_cast<std::size_t>(settings_.zones.at(x, y));
  }
  void lay(ContactLaw& law, const GroundFriction& ground) const {
    law.friction = ground.friction_coefficient * (1 - ground.pore_pressure_ratio);
    // A particle in the first layer stands on an area of V/dx.
    law.cohesion_rate = ground.cohesion_pa / (settings_.reference_density * settings_.spacing);
    law.cohesion_distance = ground.cohesion_pa > 0 ? settings_.spacing : -1;
  }
  ContactLaw law_at(const Domain& domain, const ParticleSet& p, std::size_t i,
                    std::size_t zone) const {
    const GroundFriction& ground = settings_.bed[zone];
    BasalResistance bed;
    bed.friction_coefficient = ground.friction_coefficient;
    bed.pore_pressure_ratio = ground.pore_pressure_ratio;
    bed.cohesion_pa = ground.cohesion_pa;
    double x = p.x[i], y = p.y[i], z = 0;
    domain.wrap(x, y, z);
    bed = settings_.rasters.over(bed, static_cast<int>(zone), x, y);
    ContactLaw law = laws_[zone];
    lay(law, {bed.friction_coefficient, bed.pore_pressure_ratio, bed.cohesion_pa});
    return law;
  }

  std::size_t set_;
  ContactSettings settings_;
  std::vector<ContactLaw> laws_;  // by zone
};

/// The domain's analytic planes, each until it is removed.
class WallContact final : public Pass {
 public:
  WallContact(std::size_t set, ContactSettings c) : set_(set), settings_(std::move(c)) {}
  std::string_view name() const override { return "wall contact"; }
  std::string_view effect() const override { return EffectName::walls; }
  Stage stage() const override { return Stage::walls; }

  void apply(State& s, double dt) override {
    s.sets[set_].ledger.spring = 0;
    for (std::size_t k = 0; k < s.domain.walls.size(); ++k) {
      const Wall& wall = s.domain.walls[k];
      if (s.time >= wall.remove_at_s) continue;
      ContactLaw law = smooth_contact(settings_);
      law.friction = settings_.liquid ? 0 : wall.friction_coefficient;
      press(s, wall, law, dt, drags_liquid(k));
    }
  }

 private:
  bool drags_liquid(std::size_t wall) const {
    if (!settings_.liquid) return false;
    const std::vector<bool>& holds = settings_.liquid->wall_holds;
    return wall < holds.size() && holds[wall];
  }

  void press(State& s, const Wall& wall, const ContactLaw& law, double dt, bool drags) const {
    MovingSet& p = s.sets[set_];
    const Field* grains = p.find(fields::grain_share);
    const double* share = grains ? grains->component[0].data() : nullptr;
    const double kick = kick_time(s, dt);
    const WallPressure pressure = WallPressure::of_walls(p, settings_);
    const StartVelocity start(p);
    const double support_radius = 2 * settings_.smoothing_length;
    const Vec3 n = wall.normal;
    const ContactSums sums = ordered_reduce(
        p.size(), s.threads, ContactSums{},
        [&](std::size_t begin, std::size_t end, ContactSums& out) {
          for (std::size_t i = begin; i < end; ++i) {
            const double d = (Vec3(p.x[i], p.y[i], p.z[i]) - wall.point).dot(n);
            if (d >= support_radius) continue;
            double support = 0;
            if (pressure.acts())
              support = pressure.acceleration(i, plane_integral(d, settings_.smoothing_length),
                                              n.x(), n.y(), n.z());
            out.add(apply_contact(law, d, n.x(), n.y(), n.z(), support, dt, start(i).data(),
                                  p.vx[i], p.vy[i], p.vz[i]),
                    p.mass[i]);
            if (drags)
              out.friction += p.mass[i] * drag_along(n, start(i), kick,
                                                     WallShear(settings_, d, share ? share[i] : 0),
                                                     p.vx[i], p.vy[i], p.vz[i]);
          }
        },
        combine);
    account(p, sums);
    p.ledger.spring += sums.spring;
  }

  std::size_t set_;
  ContactSettings settings_;
};

}  // namespace

void add_ground_lookup(Step& step, std::size_t set, const ContactSettings& settings) {
  step.add(std::make_unique<BoundaryPass>(set, settings));
}

void add_terrain_contact(Step& step, std::size_t set, const ContactSettings& settings) {
  add_ground_lookup(step, set, settings);
  if (settings.liquid)
    add_liquid_contact(step, set, settings);
  else
    step.add(std::make_unique<GroundContact>(set, settings));
}

void add_wall_contact(Step& step, std::size_t set, const ContactSettings& settings) {
  step.add(std::make_unique<WallContact>(set, settings));
}

}  // namespace sturz
