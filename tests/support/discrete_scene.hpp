// SPDX-License-Identifier: Apache-2.0
/// Grains set down by hand: gravity, their contacts, the ground and motion alone.
#pragma once

#include "engine/effects/discrete/effect.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "tests/support/hand_made.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace sturz::test {

struct SetDown {
  Vec3 position{0, 0, 0}, velocity{0, 0, 0}, spin{0, 0, 0};
  double radius = 0.5;
};

struct GrainScene {
  double gravity = standard_gravity;
  double slope = 0;  ///< fall per metre eastward
  int cells = 64;
  Domain domain;
  DiscreteSettings grains;

  GrainScene() {
    grains.material.youngs_modulus = 1e8;
    grains.material.poisson_ratio = 0.3;
    grains.material.density = 2400;
    grains.rolling_friction = 0;
    grains.bed_rolling_friction = 0;
  }
};

class GrainRun {
 public:
  GrainRun(const std::vector<SetDown>& grains, const GrainScene& scene, int threads = 1)
      : state(even_ground(scene.cells, scene.slope), scene.domain), settings(scene.grains) {
    MovingSet& p = state.grains();
    state.gravity = scene.gravity;
    state.threads = threads;
    p.grow(grains.size());
    for (std::size_t i = 0; i < grains.size(); ++i) put(i, grains[i]);
    p.start_x = p.x, p.start_y = p.y;
    if (scene.domain.x.active || scene.domain.y.active)
      p.wrapped_x.assign(p.size(), 0), p.wrapped_y.assign(p.size(), 0);
    ContactSettings look;
    look.spacing = 1.4 * settings.diameter;
    look.smoothing_length = 0.7 * settings.diameter;
    add_gravity(step, state, 0);
    add_ground_lookup(step, 0, look);
    add_discrete_grains(step, state, 0, settings);
    add_motion(step, 0, {settings.diameter, settings.diameter});
    for (std::size_t i = 0; i < grains.size(); ++i)
      for (int c = 0; c < 3; ++c) p.components(fields::spin)[c][i] = grains[i].spin[c];
    refresh_motion(state, p, 0);
    p.ledger.kinetic_0 = p.ledger.kinetic;
  }

  /// Equal steps of about `dt` to `time`.
  void run(double time, double dt) {
    const int n = static_cast<int>(std::ceil((time - state.time) / dt - 1e-9));
    const double each = (time - state.time) / n;
    for (int k = 0; k < n; ++k) step.apply(state, each);
  }
  MovingSet& grains() { return state.grains(); }
  const Ledger& ledger() const { return state.grains().ledger; }
  Vec3 velocity(std::size_t i) const {
    const MovingSet& p = state.grains();
    return {p.vx[i], p.vy[i], p.vz[i]};
  }
  Vec3 position(std::size_t i) const {
    const MovingSet& p = state.grains();
    return {p.x[i], p.y[i], p.z[i]};
  }
  Vec3 spin(std::size_t i) const {
    const auto& w = state.grains().components(fields::spin);
    return {w[0][i], w[1][i], w[2][i]};
  }
  double radius(std::size_t i) const {
    return std::cbrt(0.75 * state.grains().mass[i] /
                     (std::numbers::pi * settings.material.density));
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

  State state;
  Step step;
  DiscreteSettings settings;

 private:
  void put(std::size_t i, const SetDown& g) {
    MovingSet& p = state.grains();
    p.x[i] = g.position.x(), p.y[i] = g.position.y(), p.z[i] = g.position.z();
    p.vx[i] = g.velocity.x(), p.vy[i] = g.velocity.y(), p.vz[i] = g.velocity.z();
    p.mass[i] = 4.0 / 3 * std::numbers::pi * settings.material.density * std::pow(g.radius, 3);
  }
};

/// n x n x n grains of about 1 m, `pitch` apart and shaken, the lowest half a pitch above level
/// ground around the origin.
inline std::vector<SetDown> heap(int n, double pitch, double shake = 0.03, double spread = 0.05) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<SetDown> out;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        SetDown g;
        g.position = pitch * Vec3(i - 0.5 * n + 0.5, j - 0.5 * n + 0.5, k + 0.5);
        for (int c = 0; c < 3; ++c) g.position[c] += shake * unit(random);
        g.radius = 0.5 * (1 + spread * unit(random));
        out.push_back(g);
      }
  return out;
}

}  // namespace sturz::test
