// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/discrete/effect.hpp"

#include "engine/core/parallel.hpp"
#include "engine/effects/discrete/pairs.hpp"
#include "engine/effects/discrete/planes.hpp"
#include "engine/effects/fields.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace sturz {
namespace {

/// Beyond the largest sum of two radii, in mean diameters: lists last some ten steps or more.
constexpr double skin_share = 0.2;

/// What the passes share.
struct Grains {
  Grains(std::size_t of, DiscreteSettings with)
      : set(of), settings(std::move(with)), pairs(skin_share * settings.diameter) {}

  std::size_t set;
  DiscreteSettings settings;
  GrainPairs pairs;
  std::vector<double> radius;  ///< by storage index [m]
};

/// Looks after the pairs, and notes the velocities at the start of the step.
class GrainLists final : public Pass {
 public:
  explicit GrainLists(std::shared_ptr<Grains> grains) : grains_(std::move(grains)) {}
  std::string_view name() const override { return "pairs of grains"; }
  Stage stage() const override { return Stage::neighbors; }

  void apply(State& s, double) override {
    MovingSet& p = s.sets[grains_->set];
    if (p.order_changed || grains_->radius.size() != p.size()) {
      grains_->radius.resize(p.size());
      for (std::size_t i = 0; i < p.size(); ++i)
        grains_->radius[i] = sphere_radius(p.mass[i], grains_->settings.material.density);
    }
    const double dropped = grains_->pairs.update(s.domain, p, grains_->radius, s.threads);
    p.ledger.elastic -= dropped;
    p.ledger.lost_energy += dropped;
    p.n_listed = p.size();
    auto& before = p.components(fields::velocity_before);
    std::copy(p.vx.begin(), p.vx.end(), before[0].begin());
    std::copy(p.vy.begin(), p.vy.end(), before[1].begin());
    std::copy(p.vz.begin(), p.vz.end(), before[2].begin());
  }
  std::size_t bytes() const override { return grains_->pairs.bytes(); }

 private:
  std::shared_ptr<Grains> grains_;
};

struct PairForce {
  Vec3 force{0, 0, 0}, torque_a{0, 0, 0}, torque_b{0, 0, 0};
};

/// Of a block of pairs or of grains.
struct Account {
  double elastic = 0, sliding = 0, bed_sliding = 0, damping = 0;
  double work = 0, spin_work = 0, rotational = 0, impulse_scale = 0;
  double overlap = 0;  ///< greatest, over the radius
  Vec3 impulse{0, 0, 0};
};

void combine(Account& total, const Account& part) {
  total.elastic += part.elastic;
  total.sliding += part.sliding;
  total.bed_sliding += part.bed_sliding;
  total.damping += part.damping;
  total.work += part.work;
  total.spin_work += part.spin_work;
  total.rotational += part.rotational;
  total.impulse_scale += part.impulse_scale;
  total.overlap = std::max(total.overlap, part.overlap);
  total.impulse += part.impulse;
}

class GrainContacts final : public Pass {
 public:
  explicit GrainContacts(std::shared_ptr<Grains> grains)
      : grains_(std::move(grains)), planes_(grains_->settings) {
    const DiscreteSettings& c = grains_->settings;
    law_.modulus = contact_modulus(c.material, c.material);
    law_.shear_modulus = contact_shear_modulus(c.material, c.material);
    law_.damping = damping_ratio(c.restitution);
    law_.friction = c.friction;
  }
  std::string_view name() const override { return "grain contacts"; }
  Stage stage() const override { return Stage::contact; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    const double v = s.sets[grains_->set].motion.max_speed;
    out.push_back({"grain contact", grain_time_step(grains_->settings, v)});
  }

  void apply(State& s, double full) override {
    MovingSet& p = s.sets[grains_->set];
    // The first kick starts from v_0 and needs half a step to reach v_{1/2}.
    const double dt = s.n_steps == 0 ? 0.5 * full : full;
    predict(s, p);
    forces_.resize(grains_->pairs.pairs().size());
    Account total = ordered_reduce(
        forces_.size(), s.threads, Account{},
        [&](std::size_t begin, std::size_t end, Account& out) {
          for (std::size_t k = begin; k < end; ++k) press(k, s.previous_dt, dt, out);
        },
        combine);
    planes_.start(s, p);
    combine(total, ordered_reduce(
                       p.size(), s.threads, Account{},
                       [&](std::size_t begin, std::size_t end, Account& out) {
                         for (std::size_t i = begin; i < end; ++i) push(s, p, i, dt, out);
                       },
                       combine));
    account(p.ledger, total);
    greatest_overlap_ = std::max(greatest_overlap_, total.overlap);
  }

  void warnings(const State&, std::vector<std::string>& out) const override {
    if (greatest_overlap_ <= 0.3) return;
    out.push_back("soft grains: a contact overlapped by " +
                  std::to_string(std::lround(100 * greatest_overlap_)) +
                  " % of a radius. Use a smaller grains.discrete.greatest_overlap");
  }
  std::size_t bytes() const override {
    return forces_.capacity() * sizeof(PairForce) + grains_now_.capacity() * sizeof(GrainMotion) +
           planes_.bytes();
  }

 private:
  /// Motion of all grains at x_n: velocities are known half a step before.
  void predict(const State& s, const MovingSet& p) {
    const auto& before = p.components(fields::velocity_before);
    const auto& spin = p.components(fields::spin);
    const auto& last = p.components(fields::grain_acceleration);
    const double half = 0.5 * s.previous_dt;  // zero before the first step, as it must be
    grains_now_.resize(p.size());
    parallel_ranges(p.size(), reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        GrainMotion& g = grains_now_[i];
        g.position = {p.x[i], p.y[i], p.z[i]};
        g.velocity = {before[0][i], before[1][i], before[2][i]};
        g.ahead = g.velocity + half * Vec3(last[0][i], last[1][i], last[2][i] - s.gravity);
        g.spin = {spin[0][i], spin[1][i], spin[2][i]};
        g.spin_ahead = g.spin + half * Vec3(last[3][i], last[4][i], last[5][i]);
        g.radius = grains_->radius[i];
        g.mass = p.mass[i];
      }
    });
  }

  void press(std::size_t k, double since, double dt, Account& out) {
    GrainPair& pair = grains_->pairs.pairs()[k];
    const GrainMotion &a = grains_now_[pair.a], &b = grains_now_[pair.b];
    const Vec3 offset = a.position - b.position - pair.image;
    const double reach = a.radius + b.radius, distance2 = offset.squaredNorm();
    if (!(distance2 < reach * reach)) {
      if (pair.memory.overlap > 0) pair.memory.open();
      return;
    }
    const double distance = std::sqrt(distance2), overlap = reach - distance;
    const Vec3 normal = distance > 0 ? Vec3(offset / distance) : Vec3(0, 0, 1);
    pair.memory.close_to(overlap);
    ContactPair law = law_;
    law.radius = a.radius * b.radius / reach;
    law.mass = a.mass * b.mass / (a.mass + b.mass);
    const double ja = a.rolling_inertia(), jb = b.rolling_inertia();
    const Vec3 arm_a = (0.5 * overlap - a.radius) * normal;
    const Vec3 arm_b = (b.radius - 0.5 * overlap) * normal;
    TouchMotion m;
    m.velocity = a.ahead + a.spin_ahead.cross(arm_a) - b.ahead - b.spin_ahead.cross(arm_b);
    m.slip = since * (a.velocity + a.spin.cross(arm_a) - b.velocity - b.spin.cross(arm_b));
    m.spin = a.spin_ahead - b.spin_ahead;
    m.roll = since * (a.spin - b.spin);
    const TouchForce f = press_grains(
        law, {grains_->settings.rolling_friction, ja * jb / (ja + jb)}, normal, m, pair.memory);
    PairForce& force = forces_[k];
    force.force = f.force;
    force.torque_a = arm_a.cross(f.force) + f.moment;
    force.torque_b = -arm_b.cross(f.force) - f.moment;
    out.elastic += pair.memory.stored;
    out.sliding += f.sliding;
    out.damping += dt * f.damping;
    out.overlap = std::max(out.overlap, pair.memory.loaded / std::min(a.radius, b.radius));
  }

  /// All forces on one grain, in the order of its pairs, and what they make of its motion.
  void push(const State& s, MovingSet& p, std::size_t i, double dt, Account& out) {
    Vec3 force(0, 0, 0), torque(0, 0, 0);
    const auto& pairs = grains_->pairs.pairs();
    grains_->pairs.for_each_of(i, [&](std::size_t k, bool first) {
      if (!(pairs[k].memory.loaded > 0)) return;
      const PairForce& f = forces_[k];
      force += first ? f.force : Vec3(-f.force);
      torque += first ? f.torque_a : f.torque_b;
    });
    out.impulse += dt * force;
    out.impulse_scale += dt * force.norm();
    const PlaneForce plane = planes_.press(s, p, grains_now_[i], i);
    force += plane.force, torque += plane.torque;
    out.elastic += plane.stored;
    out.bed_sliding += plane.sliding;
    out.damping += dt * plane.damping;
    out.overlap = std::max(out.overlap, plane.overlap);

    const GrainMotion& g = grains_now_[i];
    const double inertia = 0.4 * g.mass * g.radius * g.radius;
    const Vec3 a = force / g.mass, spin_a = torque / inertia;
    p.vx[i] += dt * a.x(), p.vy[i] += dt * a.y(), p.vz[i] += dt * a.z();
    const Vec3 mean = 0.5 * (g.velocity + Vec3(p.vx[i], p.vy[i], p.vz[i]));
    const Vec3 spin = g.spin + dt * spin_a;
    auto& spins = p.components(fields::spin);
    auto& last = p.components(fields::grain_acceleration);
    for (int c = 0; c < 3; ++c)
      spins[c][i] = spin[c], last[c][i] = a[c], last[c + 3][i] = spin_a[c];
    out.work += dt * force.dot(mean);
    out.spin_work += dt * torque.dot(0.5 * (g.spin + spin));
    out.rotational += 0.5 * inertia * spin.squaredNorm();
  }

  /// See add_discrete_grains. What went into spins is accounted for as work of isolated particles
  /// is: it stands in `rotational` as long as it is there.
  static void account(Ledger& ledger, const Account& a) {
    ledger.stress_work += a.work + a.spin_work + a.bed_sliding;
    ledger.contact_work -= a.spin_work;
    ledger.isolated_work -= a.spin_work;
    ledger.friction += a.bed_sliding;
    ledger.plastic += a.sliding;
    ledger.collisions += a.damping;
    ledger.stress_power += a.elastic - ledger.elastic + a.sliding + a.damping;
    ledger.elastic = a.elastic;
    ledger.rotational = a.rotational;
    ledger.stress_impulse += a.impulse;
    ledger.stress_impulse_scale += a.impulse_scale;
  }

  std::shared_ptr<Grains> grains_;
  GrainPlanes planes_;
  ContactPair law_;
  std::vector<GrainMotion> grains_now_;
  std::vector<PairForce> forces_;
  double greatest_overlap_ = 0;
};

}  // namespace

double grain_time_step(const DiscreteSettings& c, double speed) {
  const double radius = 0.5 * c.diameter;
  const double mass = sphere_mass(radius, c.material.density);
  ContactPair pair;
  pair.modulus = contact_modulus(c.material, c.material);
  pair.radius = 0.5 * radius;
  pair.mass = 0.5 * mass;
  return contact_time_step(c.material, radius, pair, std::max(speed, 1e-3));
}

void add_discrete_grains(Step& step, State& state, std::size_t set,
                         const DiscreteSettings& settings) {
  MovingSet& p = state.sets[set];
  for (const FieldKey* key : {&fields::velocity_before, &fields::spin, &fields::grain_acceleration})
    p.add(*key);
  auto grains = std::make_shared<Grains>(set, settings);
  step.add(std::make_unique<GrainLists>(grains));
  step.add(std::make_unique<GrainContacts>(grains));
}

std::size_t discrete_bytes_per_particle() {
  constexpr std::size_t pairs = 6;  // within the skin, dense
  return pairs * (2 * sizeof(GrainPair) + sizeof(PairForce) + 8) + sizeof(GrainMotion) +
         sizeof(TouchMemory) + sizeof(double);
}

}  // namespace sturz
