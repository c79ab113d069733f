// SPDX-License-Identifier: Apache-2.0
/// What the contacts with ground and walls count, and what they start from.
#pragma once

#include "engine/effects/bed/effect.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/state.hpp"
#include "engine/laws/braking.hpp"
#include "engine/laws/contact_impulse.hpp"

#include <cmath>
#include <cstddef>

namespace sturz {

struct ContactSums {
  double pressure_work = 0, contact_work = 0, friction = 0, spring = 0;
  Vec3 along{0, 0, 0};  ///< impulse of the ground's images along it, which the kick holds
  double pushed = 0;    ///< that of all their pushes, whatever their directions

  void add(const ContactEnergy& e, double mass) {
    pressure_work += mass * e.pressure_work;
    contact_work += mass * e.contact_work;
    friction += mass * e.friction;
    spring += mass * e.spring;
  }
};

inline void combine(ContactSums& total, const ContactSums& block) {
  total.pressure_work += block.pressure_work;
  total.contact_work += block.contact_work;
  total.friction += block.friction;
  total.spring += block.spring;
  total.along += block.along;
  total.pushed += block.pushed;
}

/// Spring and damper of a surface that does not rub.
inline ContactLaw smooth_contact(const ContactSettings& c) {
  ContactLaw law;
  law.stiffness = c.stiffness;
  law.damping = 2 * damping_ratio(c.restitution) * std::sqrt(c.stiffness);
  law.contact_distance = 0.5 * c.spacing;
  law.cohesion_distance = -1;
  return law;
}

inline void account(MovingSet& p, const ContactSums& sums) {
  p.ledger.stress_work += sums.pressure_work;
  p.ledger.contact_work += sums.contact_work;
  p.ledger.friction += sums.friction;
}

/// The same for the ground, which comes after the walls.
inline void account_ground(const Domain& domain, MovingSet& p, const ContactSums& sums) {
  account(p, sums);
  // Of walls, which come first, it holds theirs already.
  p.ledger.spring = (domain.walls.empty() ? 0 : p.ledger.spring) + sums.spring;
  p.ledger.stress_impulse -= sums.along;  // that of pairs alone, to the rounding of both
  p.ledger.stress_impulse_scale += sums.pushed;
}

/// Integral of the smoothing kernel over a plane at distance d (SmoothingKernel::plane_integral),
/// once per step and particle in the hot path.
inline double plane_integral(double d, double h) {
  const double y = 1 - std::fmax(d, 0.0) / (2 * h), y2 = y * y, y5 = y2 * y2 * y;
  return y > 0 ? 10.5 / h * y5 * (1 + y * (-1.5 + y * (4.0 / 7.0))) : 0;
}

/// Velocities at the start of the step, as the gather pass left them.
class StartVelocity {
 public:
  explicit StartVelocity(const ParticleSet& p)
      : set_(p), before_(set_.find(fields::velocity_before)) {}
  Vec3 operator()(std::size_t i) const {
    if (!before_) return {set_.vx[i], set_.vy[i], set_.vz[i]};
    return {before_->component[0][i], before_->component[1][i], before_->component[2][i]};
  }

 private:
  const ParticleSet& set_;
  const Field* before_;
};

/// The time over which a step changes velocities [s].
inline double kick_time(const State& s, double dt) { return s.n_steps == 0 ? 0.5 * dt : dt; }

/// What walls gave of a change of velocity before the ground's contact. Its work was accounted
/// for with the velocity that they left; it is that at the end of the step that counts.
inline Vec3 by_walls(const State& s, const MovingSet& p, std::size_t i, const Vec3& change,
                     double dt) {
  const Vec3 kicked = kick_time(s, dt) * Vec3(p.ax[i], p.ay[i], p.az[i] - s.gravity);
  const Field* exchange = p.find(fields::exchange_velocity);
  if (!exchange) return change - kicked;
  const auto& liquid = exchange->component;  // accounts for itself
  return change - kicked - Vec3(liquid[0][i], liquid[1][i], liquid[2][i]);
}

/// A drag along a surface with the normal n on a velocity that forces have changed already, as the
/// exact solution of dv/dt = pull - plastic v/|v| - rate v over the kick: no step is too long for
/// it, a steady flow has its speed at any step, and it stops but never turns what it drags. \param
/// drag    of a speed [m/s]: an object with `plastic` [m/s^2] and `rate` [1/s]; where it has
/// `even()`, that says whether it is the same at any speed \param before velocity at the start of
/// the step \param vx,vy,vz  in and out [m/s] \return what the motion lost [J/kg]
template <class Drag>
double drag_along(const Vec3& n, const Vec3& before, double kick, Drag&& drag, double& vx,
                  double& vy, double& vz) {
  const Vec3 found(vx, vy, vz), start = before - before.dot(n) * n;
  const Vec3 trial = found - found.dot(n) * n, pull = (trial - start) / kick;
  const auto at = [&](double speed) {
    const auto law = drag(speed);
    return braked(start, pull, law.plastic, law.rate, kick);
  };
  // At the mean speed of the step, found from the drag at its start.
  const double speed = start.norm();
  bool even = false;
  if constexpr (requires { drag.even(); }) even = drag.even();
  const Vec3 after = even ? at(1) : at(0.5 * (speed + at(speed).norm()));
  const Vec3 taken = trial - after, now = found - taken;
  vx = now.x(), vy = now.y(), vz = now.z();
  return 0.5 * taken.dot(before + now);
}

}  // namespace sturz
