// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/isolated/bodies.hpp"

#include <Eigen/Geometry>

#include <algorithm>

namespace sturz {
namespace {

/// Velocity of the point `arm` away from a body's centre.
Vec3 velocity_at(const Vec3& velocity, const Vec3& spin, const Vec3& arm) {
  return velocity + spin.cross(arm);
}

/// The point of contact lies midway in the overlap of two spheres, on the ground's plane else.
void press(IsolatedContact& c, std::vector<IsolatedBody>& bodies, double dt) {
  measure(c, bodies);
  // A contact that has opened again starts loading from where it is.
  c.unloaded = std::clamp(c.overlap, 0.0, c.unloaded);
  c.stored = 0;
  if (!(c.loaded() > 0)) {
    c.history.setZero();
    return;
  }
  const bool pair = c.b != IsolatedContact::ground;
  IsolatedBody& a = bodies[c.a];
  const Vec3 arm_a = -(a.radius - (pair ? 0.5 : 1.0) * c.overlap) * c.normal;
  Vec3 now = velocity_at(a.velocity, a.spin, arm_a);
  Vec3 ahead = velocity_at(a.velocity_ahead, a.spin_ahead, arm_a);
  Vec3 arm_b(0, 0, 0);
  if (pair) {
    const IsolatedBody& b = bodies[c.b];
    arm_b = (b.radius - 0.5 * c.overlap) * c.normal;
    now -= velocity_at(b.velocity, b.spin, arm_b);
    ahead -= velocity_at(b.velocity_ahead, b.spin_ahead, arm_b);
  }
  const ContactForce f = press_contact(c.law, c.loaded(), c.normal, ahead, dt * now, c.history);
  c.stored = f.stored;
  a.force += f.force;
  a.torque += arm_a.cross(f.force);
  if (!pair) return;
  bodies[c.b].force -= f.force;
  bodies[c.b].torque -= arm_b.cross(f.force);
}

void kick(IsolatedBody& b, double dt) {
  b.velocity += dt / b.mass * b.force;
  b.spin += dt / b.inertia() * b.torque;
}

/// Forces where the bodies are; tangential springs stretch by the velocities times dt.
void press_all(std::vector<IsolatedBody>& bodies, std::vector<IsolatedContact>& contacts,
               double dt) {
  for (IsolatedBody& b : bodies) {
    b.velocity_ahead = b.velocity + 0.5 * dt / b.mass * b.force;
    b.spin_ahead = b.spin + 0.5 * dt / b.inertia() * b.torque;
    b.force.setZero();
    b.torque.setZero();
  }
  for (IsolatedContact& c : contacts) press(c, bodies, dt);
}

}  // namespace

void measure(IsolatedContact& c, const std::vector<IsolatedBody>& bodies) {
  const IsolatedBody& a = bodies[c.a];
  if (c.b == IsolatedContact::ground) {
    c.overlap = a.radius - c.height - (a.position - a.start).dot(c.normal);
    return;
  }
  const IsolatedBody& b = bodies[c.b];
  const Vec3 offset = a.position - b.position - c.image;
  const double distance = offset.norm();
  c.overlap = a.radius + b.radius - distance;
  if (distance > 0) c.normal = offset / distance;
}

void step_bodies(std::vector<IsolatedBody>& bodies, std::vector<IsolatedContact>& contacts,
                 double dt, int n) {
  const double h = dt / n;
  press_all(bodies, contacts, 0);
  for (int k = 0; k < n; ++k) {
    for (IsolatedBody& b : bodies) {
      kick(b, 0.5 * h);
      b.position += h * b.velocity;
    }
    press_all(bodies, contacts, h);
    for (IsolatedBody& b : bodies) kick(b, 0.5 * h);
  }
}

}  // namespace sturz
