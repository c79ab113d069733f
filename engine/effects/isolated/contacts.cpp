// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/isolated/contacts.hpp"

#include "engine/effects/fields.hpp"
#include "engine/effects/isolated/bodies.hpp"
#include "engine/effects/isolated/contact_memory.hpp"
#include "engine/effects/isolated/search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz {
namespace {

class IsolatedContacts final : public Pass {
 public:
  IsolatedContacts(std::size_t set, const IsolatedContactSettings& c, Field& spin)
      : set_(set), settings_(c), spin_(spin) {
    const double least = softest_modulus(c.material.density, c.speed_bound, c.greatest_share);
    material_ = softened(c.material, least);
    law_.modulus = contact_modulus(material_, material_);
    law_.shear_modulus = contact_shear_modulus(material_, material_);
    law_.damping = damping_ratio(c.restitution);
    law_.friction = c.friction;
    law_.never_pulls = c.never_pulls;
    ground_law_ = law_;
    ground_law_.damping = damping_ratio(c.ground_restitution);
    ground_law_.friction = c.ground_friction;
  }
  std::string_view name() const override { return "isolated contacts"; }
  std::string_view effect() const override { return EffectName::isolated_contacts; }
  Stage stage() const override { return Stage::contact; }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[set_];
    gather(p);
    bodies_.clear();
    contacts_.clear();
    choose(s.domain, p, dt);
    if (!contacts_.empty()) {
      memory_.recall(contacts_, bodies_);
      step_bodies(bodies_, contacts_, dt, fine_steps(dt));
      hand_on(p, s.gravity, dt);
    }
    memory_.remember(contacts_, bodies_);
    account_now(p);
  }

  std::size_t bytes() const override {
    return search_.bytes() + spheres_.capacity() * sizeof(IsolatedSphere) +
           bodies_.capacity() * sizeof(IsolatedBody) +
           contacts_.capacity() * sizeof(IsolatedContact) + memory_.bytes();
  }

 private:
  /// The isolated particles of this step; one that was listed a step ago has no spin.
  void gather(MovingSet& p) {
    spheres_.clear();
    new_ids_.clear();
    max_speed_ = 0;
    for (std::size_t i = p.n_listed; i < p.size(); ++i) {
      spheres_.push_back(sphere(p, i));
      max_speed_ = std::max(max_speed_, spheres_.back().velocity.norm());
      new_ids_.push_back(p.id[i]);
      if (!std::binary_search(ids_.begin(), ids_.end(), p.id[i]))
        for (auto& component : spin_.component) component[i] = 0;
    }
    std::sort(new_ids_.begin(), new_ids_.end());
    ids_.swap(new_ids_);
  }

  IsolatedSphere sphere(const ParticleSet& p, std::size_t i) const {
    const double volume = p.mass[i] / settings_.material.density;
    const double radius = std::cbrt(0.75 / std::numbers::pi * volume);
    return {{p.x[i], p.y[i], p.z[i]}, {p.vx[i], p.vy[i], p.vz[i]}, radius, p.id[i]};
  }

  double ground_gap(const MovingSet& p, std::size_t k) const {
    const std::size_t i = p.n_listed + k;
    if (i >= p.boundary.distance.size() || p.fate[i] != Fate::stays)
      return std::numeric_limits<double>::infinity();
    return p.boundary.distance[i] - spheres_[k].radius;
  }
  Vec3 ground_normal(const MovingSet& p, std::size_t k) const {
    const std::size_t i = p.n_listed + k;
    return {p.boundary.nx[i], p.boundary.ny[i], p.boundary.nz[i]};
  }

  /// Bodies and contacts of all groups in which two particles touch, or one the ground, within the
  /// step.
  void choose(const Domain& domain, const MovingSet& p, double dt) {
    // A hit may turn a particle round and, by a heavy one, make it faster: twice the largest
    // speed for each of two.
    const double max_gap = 4 * max_speed_ * dt + 1e-9;
    const std::vector<NearPair>& pairs = search_.find(spheres_, max_gap, domain);
    groups_.start(spheres_.size());
    bool any = false;
    for (const NearPair& pair : pairs) {
      groups_.join(pair.a, pair.b);
      if (!may_touch(spheres_[pair.a], spheres_[pair.b], pair.image, dt)) continue;
      groups_.want(pair.a);
      any = true;
    }
    for (std::uint32_t k = 0; settings_.on_ground && k < spheres_.size(); ++k) {
      const double gap = ground_gap(p, k);
      if (!(gap < max_gap)) continue;
      const double rise = spheres_[k].velocity.dot(ground_normal(p, k));
      if (gap + dt * std::min(rise, 0.0) > 0) continue;
      groups_.want(k);
      any = true;
    }
    if (!any) return;
    body_of_.assign(spheres_.size(), 0);
    for (std::uint32_t k = 0; k < spheres_.size(); ++k)
      if (groups_.wanted(k)) add_body(p, k);
    for (const NearPair& pair : pairs)
      if (groups_.wanted(pair.a)) add_contact(pair);
    for (std::uint32_t k = 0; settings_.on_ground && k < spheres_.size(); ++k)
      if (groups_.wanted(k) && ground_gap(p, k) < max_gap) add_ground(p, k);
  }

  void add_body(const MovingSet& p, std::uint32_t k) {
    const IsolatedSphere& sphere = spheres_[k];
    body_of_[k] = static_cast<std::uint32_t>(bodies_.size());
    IsolatedBody& b = bodies_.emplace_back();
    b.particle = static_cast<std::uint32_t>(p.n_listed + k);
    b.start = b.position = sphere.position;
    b.velocity = sphere.velocity;
    for (int c = 0; c < 3; ++c) b.spin[c] = spin_.component[c][b.particle];
    b.radius = sphere.radius;
    b.mass = p.mass[b.particle];
    b.id = sphere.id;
  }

  void add_contact(const NearPair& p) {
    IsolatedContact& c = contacts_.emplace_back();
    c.a = body_of_[p.a], c.b = body_of_[p.b], c.image = p.image;
    const IsolatedBody &a = bodies_[c.a], &b = bodies_[c.b];
    c.law = law_;
    c.law.radius = a.radius * b.radius / (a.radius + b.radius);
    c.law.mass = a.mass * b.mass / (a.mass + b.mass);
  }

  void add_ground(const MovingSet& p, std::uint32_t k) {
    IsolatedContact& c = contacts_.emplace_back();
    c.a = body_of_[k];
    c.normal = ground_normal(p, k);
    c.height = p.boundary.distance[p.n_listed + k];
    c.law = ground_law_;
    c.law.radius = bodies_[c.a].radius;
    c.law.mass = bodies_[c.a].mass;
  }

  double smaller_radius(const IsolatedContact& c) const {
    const double a = bodies_[c.a].radius;
    return c.b == IsolatedContact::ground ? a : std::min(a, bodies_[c.b].radius);
  }

  int fine_steps(double dt) const {
    double fine = dt;
    for (const IsolatedContact& c : contacts_)
      fine = std::min(
          fine, contact_time_step(material_, smaller_radius(c), c.law, settings_.speed_bound));
    return static_cast<int>(std::ceil(dt / fine));
  }

  /// Velocities as they are now, and positions from which the drift arrives where the bodies are.
  /// The work is taken with the mean velocity of the step, as Ledger has it: of what the kick
  /// and the ground did before, only the kick's work is accounted later, with the velocity that
  /// this pass leaves.
  void hand_on(MovingSet& p, double gravity, double dt) {
    const bool later = p.has(fields::velocity_before) && p.ax.size() >= p.size();
    double work = 0, risen = 0;
    for (const IsolatedBody& b : bodies_) {
      const std::size_t i = b.particle;
      const Vec3 before(p.vx[i], p.vy[i], p.vz[i]), change = b.velocity - before;
      Vec3 mean = before + 0.5 * change;
      if (later) mean -= 0.5 * dt * Vec3(p.ax[i], p.ay[i], p.az[i] - gravity);
      work += b.mass * change.dot(mean);
      p.vx[i] = b.velocity.x(), p.vy[i] = b.velocity.y(), p.vz[i] = b.velocity.z();
      const Vec3 from = b.position - dt * b.velocity;
      risen += b.mass * (from.z() - p.z[i]);
      p.x[i] = from.x(), p.y[i] = from.y(), p.z[i] = from.z();
      for (int c = 0; c < 3; ++c) spin_.component[c][i] = b.spin[c];
    }
    p.ledger.contact_work += work;
    p.ledger.isolated_work += work;
    p.ledger.potential += gravity * risen;
  }

  void account_now(MovingSet& p) const {
    double rotational = 0, elastic = 0;
    for (std::size_t k = 0; k < spheres_.size(); ++k) {
      const std::size_t i = p.n_listed + k;
      double w2 = 0;
      for (const auto& component : spin_.component) w2 += component[i] * component[i];
      rotational += 0.2 * p.mass[i] * spheres_[k].radius * spheres_[k].radius * w2;
    }
    for (const IsolatedContact& c : contacts_) elastic += c.stored;
    p.ledger.rotational = rotational;
    p.ledger.isolated_elastic = elastic;
  }

  std::size_t set_;
  IsolatedContactSettings settings_;
  Field& spin_;
  GrainMaterial material_;
  ContactPair law_, ground_law_;
  IsolatedSearch search_;
  IsolatedGroups groups_;
  std::vector<IsolatedSphere> spheres_;
  std::vector<std::uint32_t> ids_, new_ids_, body_of_;
  std::vector<IsolatedBody> bodies_;
  std::vector<IsolatedContact> contacts_;
  ContactMemory memory_;
  double max_speed_ = 0;
};

}  // namespace

void add_isolated_contacts(Step& step, State& state, std::size_t set,
                           const IsolatedContactSettings& settings) {
  step.add(std::make_unique<IsolatedContacts>(set, settings, state.sets[set].add(fields::spin)));
}

}  // namespace sturz
