// SPDX-License-Identifier: Apache-2.0
/// Isolated particles thrown by hand: only gravity, their contacts and motion.
#pragma once

#include "engine/effects/fields.hpp"
#include "engine/effects/isolated/contacts.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "tests/support/hand_made.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

namespace sturz::test {

constexpr double contact_density = 2600;

struct Thrown {
  Vec3 position, velocity;
  double radius = 0.5;
};

/// Notes the velocities at the start of the step, as the gather pass of grain stress does.
class StartNote final : public Pass {
 public:
  explicit StartNote(Field& before) : before_(before) {}
  std::string_view name() const override { return "start of step"; }
  std::string_view effect() const override { return EffectName::bookkeeping; }
  Stage stage() const override { return Stage::gather; }
  void apply(State& s, double) override {
    before_.component = {s.grains().vx, s.grains().vy, s.grains().vz};
  }

 private:
  Field& before_;
};

struct Scene {
  double gravity = 0;
  bool works = false;   ///< account works with the velocity before
  bool ground = false;  ///< look the ground up
  Domain domain;
  IsolatedContactSettings contacts;
};

class Flight {
 public:
  Flight(const std::vector<Thrown>& particles, const Scene& scene)
      : state(even_ground(64), scene.domain) {
    MovingSet& p = state.grains();
    state.gravity = scene.gravity;
    p.grow(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) put(i, particles[i]);
    add_gravity(step, state, 0);
    if (scene.works) step.add(std::make_unique<StartNote>(p.add(fields::velocity_before)));
    if (scene.ground) {
      ContactSettings
          looks;  // a contact distance at which nothing touches: only the look-up counts
      looks.spacing = 1e-6;
      looks.smoothing_length = 4;
      looks.bed = {{0, 0, 0}};
      add_terrain_contact(step, 0, looks);
      if (!state.domain.walls.empty()) add_wall_contact(step, 0, looks);
    }
    add_isolated_contacts(step, state, 0, scene.contacts);
    add_motion(step, 0, {1, 1.3});
    refresh_motion(state, state.grains(), 0);
    state.grains().ledger.kinetic_0 = state.grains().ledger.kinetic;
  }

  void advance(double dt) { step.apply(state, dt); }
  Vec3 velocity(std::size_t i) const {
    return {state.grains().vx[i], state.grains().vy[i], state.grains().vz[i]};
  }
  Vec3 position(std::size_t i) const {
    return {state.grains().x[i], state.grains().y[i], state.grains().z[i]};
  }
  Vec3 spin(std::size_t i) const {
    const auto& w = state.grains().components(fields::spin);
    return {w[0][i], w[1][i], w[2][i]};
  }
  double radius(std::size_t i) const {
    return std::cbrt(0.75 * state.grains().mass[i] / (std::numbers::pi * contact_density));
  }
  Vec3 momentum() const {
    Vec3 sum(0, 0, 0);
    for (std::size_t i = 0; i < state.grains().size(); ++i)
      sum += state.grains().mass[i] * velocity(i);
    return sum;
  }
  Vec3 angular_momentum() const {
    Vec3 sum(0, 0, 0);
    for (std::size_t i = 0; i < state.grains().size(); ++i)
      sum += state.grains().mass[i] *
             (position(i).cross(velocity(i)) + 0.4 * radius(i) * radius(i) * spin(i));
    return sum;
  }
  /// Of motion, spins and springs [J].
  double energy() const {
    return state.grains().ledger.kinetic + state.grains().ledger.rotational +
           state.grains().ledger.isolated_elastic;
  }

  State state;
  Step step;

 private:
  void put(std::size_t i, const Thrown& t) {
    MovingSet& p = state.grains();
    p.x[i] = t.position.x(), p.y[i] = t.position.y(), p.z[i] = t.position.z();
    p.vx[i] = t.velocity.x(), p.vy[i] = t.velocity.y(), p.vz[i] = t.velocity.z();
    p.mass[i] = 4.0 / 3 * std::numbers::pi * contact_density * t.radius * t.radius * t.radius;
  }
};

inline Scene free_flight(double restitution = 0.7, double friction = 0.5) {
  Scene scene;
  scene.contacts.restitution = restitution;
  scene.contacts.friction = friction;
  scene.contacts.speed_bound = 20;
  return scene;
}

/// A bag of particles that fly towards its middle.
inline std::vector<Thrown> bag(int n, double speed, std::uint32_t seed = 3) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Thrown> particles;
  while (static_cast<int>(particles.size()) < n) {
    Thrown t;
    t.position = 3.5 * Vec3(unit(random), unit(random), unit(random));
    t.radius = 0.45 + 0.15 * unit(random);
    t.velocity =
        -speed / 3.5 * t.position + 0.3 * speed * Vec3(unit(random), unit(random), unit(random));
    t.position += Vec3(1, -2, 100);
    const bool free = std::none_of(particles.begin(), particles.end(), [&](const Thrown& o) {
      return (o.position - t.position).norm() < o.radius + t.radius + 0.02;
    });
    if (free) particles.push_back(t);
  }
  return particles;
}

}  // namespace sturz::test
