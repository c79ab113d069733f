// SPDX-License-Identifier: Apache-2.0
/// Two spheres, or a sphere and a wall, in contact: Hertz springs, dampers, sticking and sliding.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/laws/contact_impulse.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz {

/// What a grain is made of.
struct GrainMaterial {
  double youngs_modulus = 5e10;  ///< E [Pa]
  double poisson_ratio = 0.28;   ///< nu [-]
  double density = 2600;         ///< rho_p [kg/m^3]

  double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
};

/// Constants of one contact.
struct ContactPair {
  double modulus = 1;        ///< E*, 1/E* = (1-nu_i^2)/E_i + (1-nu_j^2)/E_j [Pa]
  double shear_modulus = 1;  ///< G*, 1/G* = 2(2-nu_i)(1+nu_i)/E_i + the same of j [Pa]
  double radius = 1;         ///< R*, 1/R* = 1/R_i + 1/R_j; of a wall R_i [m]
  double mass = 1;           ///< m* = m_i m_j/(m_i+m_j); of a wall m_i [kg]
  double damping = 0;        ///< b = -ln e/sqrt(ln^2 e + pi^2), see damping_ratio [-]
  double friction = 0;       ///< mu_c [-]
  /// Cuts F_n off at zero. By default the damper may pull while grains separate: only so does the
  /// restitution come out as set (0.5 gives 0.550 with the cut, docs/physics.md A.5, I14).
  bool never_pulls = false;
};

inline double contact_modulus(const GrainMaterial& a, const GrainMaterial& b) {
  return 1 / ((1 - a.poisson_ratio * a.poisson_ratio) / a.youngs_modulus +
              (1 - b.poisson_ratio * b.poisson_ratio) / b.youngs_modulus);
}

inline double contact_shear_modulus(const GrainMaterial& a, const GrainMaterial& b) {
  return 1 / (2 * (2 - a.poisson_ratio) * (1 + a.poisson_ratio) / a.youngs_modulus +
              2 * (2 - b.poisson_ratio) * (1 + b.poisson_ratio) / b.youngs_modulus);
}

/// What the contact does to the body that `normal` points into; the other one gets the opposite.
struct ContactForce {
  Vec3 force{0, 0, 0};  ///< [N]
  double normal = 0;    ///< F_n, positive: pushes [N]
  double stored = 0;    ///< elastic energy of both springs [J]
};

/// Gao et al. Eqs. (18)-(22) in the corrected forms of docs/physics.md A.5 (those of LIGGGHTS):
///   k_n = 4/3 E* sqrt(R* delta)   S_n = 2 E* sqrt(R* delta)   k_t = S_t = 8 G* sqrt(R* delta)
///   F_n = k_n delta - 2 sqrt(5/6) b sqrt(S_n m*) v_n          v_n > 0: separating
///   F_t = -k_t xi, at most mu_c |F_n|; while it sticks, - 2 sqrt(5/6) b sqrt(S_t m*) v_t
/// F_t with its damper is held to mu_c |F_n|, too, unlike there: a slow contact that slides lies at
/// the limit, and looked at anew in every step it would count as sticking in the first of them.
/// The stored energy is 8/15 E* sqrt(R*) delta^(5/2) + 1/2 k_t xi^2.
///
/// \param overlap   delta > 0 [m]; without overlap there is no force and no history
/// \param normal    unit, into the body that feels the force
/// \param velocity  of that body's contact point relative to the other's, spins included [m/s]
/// \param slip      displacement of that point relative to the other since the last call, velocity
/// times
///                  dt; its normal part does not count [m]
/// \param history   xi, the stretched tangential spring, in and out [m]
inline ContactForce press_contact(const ContactPair& pair, double overlap, const Vec3& normal,
                                  const Vec3& velocity, const Vec3& slip, Vec3& history) {
  ContactForce out;
  if (!(overlap > 0)) {
    history.setZero();
    return out;
  }
  const double root = std::sqrt(pair.radius * overlap), drag = 2 * std::sqrt(5.0 / 6);
  const double normal_stiffness = 2 * pair.modulus * root;
  const double tangential_stiffness = 8 * pair.shear_modulus * root;
  const double vn = velocity.dot(normal);
  const double spring = 2.0 / 3 * normal_stiffness * overlap;
  out.normal = spring - drag * pair.damping * std::sqrt(normal_stiffness * pair.mass) * vn;
  if (pair.never_pulls) out.normal = std::max(out.normal, 0.0);

  history += slip;
  history -= history.dot(normal) * normal;
  Vec3 tangential = -tangential_stiffness * history;
  const double size = tangential.norm(), cap = pair.friction * std::abs(out.normal);
  if (size > cap) {
    tangential *= cap / size;
    history = -tangential / tangential_stiffness;
  } else {
    tangential -= drag * pair.damping * std::sqrt(tangential_stiffness * pair.mass) *
                  (velocity - vn * normal);
    const double all = tangential.norm();
    if (all > cap) tangential *= cap / all;
  }
  out.force = out.normal * normal + tangential;
  out.stored = 0.4 * spring * overlap + 0.5 * tangential_stiffness * history.squaredNorm();
  return out;
}

/// delta_max = (15 m* v^2/(16 E* sqrt(R*)))^(2/5) of an elastic impact at speed v [m].
inline double greatest_overlap(const ContactPair& pair, double speed) {
  return std::pow(15 * pair.mass * speed * speed / (16 * pair.modulus * std::sqrt(pair.radius)),
                  0.4);
}

/// t_c = 2.87 (m*^2/(R* E*^2 v))^(1/5), how long an elastic impact at speed v lasts [s].
inline double impact_duration(const ContactPair& pair, double speed) {
  return 2.87 *
         std::pow(pair.mass * pair.mass / (pair.radius * pair.modulus * pair.modulus * speed), 0.2);
}

/// The least E* that keeps the overlap of an impact at `speed` below a share of the radius: of
/// the smaller sphere's, whatever it meets, wall or sphere [Pa]. Equal spheres need
/// (5 sqrt(2) pi/8 = 2.78) rho v^2/share^(5/2) (5 %: 5.0e3 rho v^2, A.5), a sphere that
/// meets a wall or a much larger one 5 pi/4 = 3.93 instead.
inline double softest_modulus(double density, double speed, double share = 0.05,
                              bool equal_spheres = false) {
  const double factor = 1.25 * std::numbers::pi / (equal_spheres ? std::numbers::sqrt2 : 1);
  return factor * density * speed * speed / std::pow(share, 2.5);
}

/// The material with E lowered, if need be, so that E* between two of its grains is `modulus`:
/// contacts as short as those of rock would cost a hundred times the steps (docs/physics.md A.5).
inline GrainMaterial softened(GrainMaterial material, double modulus) {
  const double youngs = 2 * (1 - material.poisson_ratio * material.poisson_ratio) * modulus;
  material.youngs_modulus = std::min(material.youngs_modulus, youngs);
  return material;
}

/// T_R = pi R sqrt(rho/G)/(0.1631 nu + 0.8766): a surface wave's path round half a sphere [s].
inline double rayleigh_time(const GrainMaterial& material, double radius) {
  return std::numbers::pi * radius * std::sqrt(material.density / material.shear_modulus()) /
         (0.1631 * material.poisson_ratio + 0.8766);
}

/// The step that resolves contacts: min(0.2 T_R, t_c/20) (docs/physics.md B.12) [s].
/// \param radius  of the smaller sphere [m]; \param speed  the fastest approach [m/s]
inline double contact_time_step(const GrainMaterial& material, double radius,
                                const ContactPair& pair, double speed) {
  return std::min(0.2 * rayleigh_time(material, radius), impact_duration(pair, speed) / 20);
}

}  // namespace sturz
