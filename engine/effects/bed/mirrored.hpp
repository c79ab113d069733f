// SPDX-License-Identifier: Apache-2.0
/// How what ground and walls mirror pushes a particle.
#pragma once

#include "engine/effects/bed/effect.hpp"
#include "engine/effects/fields.hpp"

#include <cmath>
#include <cstddef>

namespace sturz {

/// The mirror contribution of walls to the pressure force: a = 2 p_n W_plane(d) / rho along n. With
/// it the particles beside a wall carry the pressure, and the spring only guards the gap. The
/// ground mirrors the stress of contacts in the pair sweep; that of collisions here.
class WallPressure {
 public:
  static WallPressure of_walls(const MovingSet& p, const ContactSettings& c) {
    WallPressure w(p, c);
    const Field* stress = p.boundary.mirrored_walls ? nullptr : p.find(fields::stress);
    for (int k = 0; k < 6 && stress; ++k) w.stress_[k] = stress->component[k].data();
    return w;
  }
  static WallPressure of_ground(const MovingSet& p, const ContactSettings& c) {
    WallPressure w(p, c);
    if (const Field* weight = p.find(fields::ground_weight))
      w.ground_weight_ = weight->component[0].data();
    return w;
  }
  bool acts() const { return stress_[0] || kinetic_[0]; }
  /// \param plane  plane_integral at the particle's distance [1/m]
  double acceleration(std::size_t i, double plane, double nx, double ny, double nz) const {
    double snn = 0;
    if (stress_[0]) snn += normal(stress_, i, nx, ny, nz);
    if (kinetic_[0]) snn += normal(kinetic_, i, nx, ny, nz);
    if (snn >= 0) return 0;
    const double weight = ground_weight_ ? ground_weight_[i] : mirror_weight_[i];
    const double packed = packing_ ? 1 + packing_[i] : 1;
    return -2 * snn * plane * weight / (density_ * packed * (1 + density_change_[i]));
  }

 private:
  WallPressure(const MovingSet& p, const ContactSettings& c) : density_(c.reference_density) {
    if (!p.has(fields::stress)) return;
    if (const Field* kinetic = p.find(fields::kinetic_stress))
      for (int k = 0; k < 6; ++k) kinetic_[k] = kinetic->component[k].data();
    density_change_ = p.scalar(fields::density_change).data();
    if (const Field* packing = p.find(fields::packing_change))
      packing_ = packing->component[0].data();
    mirror_weight_ = p.boundary.mirror_weight.data();
  }
  static double normal(const double* const s[6], std::size_t i, double nx, double ny, double nz) {
    return nx * nx * s[0][i] + ny * ny * s[1][i] + nz * nz * s[2][i] +
           2 * (nx * ny * s[3][i] + ny * nz * s[4][i] + nz * nx * s[5][i]);
  }

  double density_;
  const float* mirror_weight_ = nullptr;
  const double* ground_weight_ = nullptr;
  const double* stress_[6] = {};
  const double* kinetic_[6] = {};  ///< of dispersed grains, see kinetic/update.hpp
  const double* density_change_ = nullptr;
  const double* packing_ = nullptr;  ///< of grains whose packing changes, see dilatancy/
};

/// The bed's friction on a particle above those that lie on it: what lies between hands on no more
/// than it bears itself. With the whole friction of a very rough bed the second layer would be held
/// as fast as the first.
/// A tenth more is let through, for stresses are noisy: a mass that slides keeps the whole friction
/// of its bed.
class HandedOn {
 public:
  HandedOn(const MovingSet& p, const ContactSettings& c)
      : least_(c.internal_friction), inv_spacing_(1 / c.spacing) {
    if (const Field* stress = p.find(fields::stress))
      for (int k = 0; k < 6; ++k) s_[k] = stress->component[k].data();
  }
  /// \param distance  to the ground [m]; \param friction  of the bed, mu_b (1 - r_u)
  double operator()(std::size_t i, double distance, double friction) const {
    const double above = std::fmin(1.0, 2 * (distance * inv_spacing_ - 0.75));
    if (!s_[0] || above <= 0 || friction <= least_) return friction;
    const double inside = std::fmin(friction, std::fmax(least_, 1.1 * stress_ratio(i)));
    return friction + above * (inside - friction);
  }

 private:
  /// sqrt(J2) / p, 0 without pressure: mu(I) where the grains yield.
  double stress_ratio(std::size_t i) const {
    const double p = -(s_[0][i] + s_[1][i] + s_[2][i]) / 3;
    if (p <= 0) return 0;
    const double x = s_[0][i] + p, y = s_[1][i] + p, z = s_[2][i] + p;
    const double shear = s_[3][i] * s_[3][i] + s_[4][i] * s_[4][i] + s_[5][i] * s_[5][i];
    return std::sqrt(0.5 * (x * x + y * y + z * z) + shear) / p;
  }

  const double* s_[6] = {};
  double least_, inv_spacing_;
};

/// What the images in the ground do to a particle: a push along the normal, which is the ground's
/// reaction and never pulls, and the pull along it, which pairs of particles share without
/// loss on a plane. Where the ground is bent it is no force of the pairs.
class GroundImages {
 public:
  explicit GroundImages(const MovingSet& p) {
    if (!p.has(fields::stress)) return;
    for (int k = 0; k < 3; ++k) a_[k] = p.boundary.from_ground[k].data();
  }
  Vec3 operator()(std::size_t i) const {
    return a_[0] ? Vec3(a_[0][i], a_[1][i], a_[2][i]) : Vec3(0, 0, 0);
  }

 private:
  const float* a_[3] = {};
};

}  // namespace sturz
