// SPDX-License-Identifier: Apache-2.0
/// One grain contact over one step: Hertz-Mindlin and rolling springs, with what they store and
/// what they dissipate.
#pragma once

#include "engine/laws/hertz_mindlin.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace sturz {

/// What a grain contact carries from step to step.
struct TouchMemory {
  Vec3 slip{0, 0, 0};   ///< tangential spring [m]
  Vec3 roll{0, 0, 0};   ///< rolling spring [rad]
  double overlap = 0;   ///< of the spheres [m]
  double unloaded = 0;  ///< part of it that no approach built up, carries nothing [m]
  double loaded = 0;    ///< the rest [m]; zero: they do not touch
  double stored = 0;    ///< elastic energy of all springs [J]

  void open() { *this = TouchMemory{}; }
  /// A contact that has opened again starts loading from where it is.
  void close_to(double now) {
    overlap = now;
    unloaded = std::clamp(now, 0.0, unloaded);
  }
};

/// Motion of one body relative to the other at the contact.
struct TouchMotion {
  Vec3 velocity{0, 0, 0};  ///< of the contact point, now [m/s]
  Vec3 slip{0, 0, 0};      ///< its way since the last look [m]
  Vec3 spin{0, 0, 0};      ///< now [rad/s]
  Vec3 roll{0, 0, 0};      ///< angle since the last look [rad]
};

struct TouchForce {
  Vec3 force{0, 0, 0};   ///< on the body that the normal points into [N]
  Vec3 moment{0, 0, 0};  ///< of rolling friction, on the same [N m]
  double sliding = 0;    ///< dissipated by slip and roll since the last look [J]
  double damping = 0;    ///< power that the dampers dissipate now [W]
};

/// Constants of rolling friction.
struct RollingLaw {
  double coefficient = 0;  ///< mu_r [-]
  double inertia = 1;      ///< about the contact point, of both bodies together [kg m^2]
};

/// Rolling friction as an elastic and plastic spring (Ai et al. 2011, model C; LIGGGHTS "epsd"):
///   k_r = 2.25 k_n mu_r^2 R*^2,  M = -k_r theta - 2 b sqrt(J k_r) dtheta/dt,  |M| <= mu_r R* F_n,
/// so that it holds a grain at rest without trembling. k_n = 2 E* sqrt(R* delta).
/// \return energy stored in the spring [J]
inline double press_rolling(const ContactPair& pair, const RollingLaw& law, double stiffness,
                            double normal_force, const Vec3& normal, const TouchMotion& m,
                            Vec3& spring, TouchForce& out) {
  spring += m.roll - m.roll.dot(normal) * normal;
  spring -= spring.dot(normal) * normal;
  const double cap = law.coefficient * pair.radius * std::max(0.0, normal_force);
  Vec3 moment = -stiffness * spring;
  const double size = moment.norm();
  if (size > cap) {
    moment *= cap / size;
    spring = -moment / stiffness;
  } else {
    const Vec3 spin = m.spin - m.spin.dot(normal) * normal;
    Vec3 all = moment - 2 * pair.damping * std::sqrt(law.inertia * stiffness) * spin;
    const double total = all.norm();
    if (total > cap) all *= cap / total;
    out.damping += (moment - all).dot(spin);
    moment = all;
  }
  out.moment = moment;
  return 0.5 * stiffness * spring.squaredNorm();
}

/// Presses a contact whose overlap is known (TouchMemory::close_to); the law is `press_contact`.
///
/// Springs along the surface get stiffer with the overlap. They keep their force then, and their
/// length where they get softer: either way they lose energy and never gain it (Thornton et al.
/// 2013), and what they lose counts as slip.
///
/// Works are taken with the mean of the forces before and after, as the accounts of the step have
/// it: what is dissipated is what neither stored nor given back, not a remainder of the motion.
inline TouchForce press_grains(const ContactPair& pair, const RollingLaw& rolling,
                               const Vec3& normal, const TouchMotion& m, TouchMemory& memory) {
  TouchForce out;
  const double loaded = memory.overlap - memory.unloaded;
  if (!(loaded > 0)) {
    memory.slip.setZero(), memory.roll.setZero();
    memory.loaded = memory.stored = 0;
    return out;
  }
  const double root = std::sqrt(pair.radius * loaded);
  const double normal_stiffness = 2 * pair.modulus * root;
  const double shear = 8 * pair.shear_modulus * root;
  const double reduced = rolling.coefficient * pair.radius;
  const double turning = 2.25 * normal_stiffness * reduced * reduced;
  const double spring = 2.0 / 3 * normal_stiffness * loaded, pressed = 0.4 * spring * loaded;
  // Of the springs along the surface, as they were left.
  const double softer = memory.loaded > 0 ? std::sqrt(memory.loaded / loaded) : 1;
  const double shear_0 = softer * shear, turning_0 = softer * turning;
  const double stored_0 =
      0.5 * (shear_0 * memory.slip.squaredNorm() + turning_0 * memory.roll.squaredNorm());
  const Vec3 force_0 = shear_0 * memory.slip, moment_0 = turning_0 * memory.roll;
  if (softer < 1) memory.slip *= softer, memory.roll *= softer;

  const ContactForce f = press_contact(pair, loaded, normal, m.velocity, m.slip, memory.slip);
  out.force = f.force;
  const double vn = m.velocity.dot(normal);
  const Vec3 tangential = f.force - f.normal * normal;
  const Vec3 sprung = -shear * memory.slip;
  out.damping = (spring - f.normal) * vn + (sprung - tangential).dot(m.velocity);
  double turned = 0;
  if (reduced > 0)
    turned = press_rolling(pair, rolling, turning, f.normal, normal, m, memory.roll, out);
  const double stored = f.stored - pressed + turned;
  const double given = 0.5 * ((force_0 + shear * memory.slip).dot(m.slip) +
                              (moment_0 + turning * memory.roll).dot(m.roll));
  out.sliding = given - (stored - stored_0);
  memory.loaded = loaded;
  memory.stored = pressed + stored;
  return out;
}

}  // namespace sturz
