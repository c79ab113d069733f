// SPDX-License-Identifier: Apache-2.0
/// A particle against ground or wall: spring, damper, and friction capped by the normal impulse.
#pragma once

#include <cmath>

namespace sturz {

/// docs/physics.md A.8 and B.10. Friction follows Gao et al. Eq. (31) as an impulse:
/// v_t <- v_t max(0, 1 - [mu (1 - r_u) J_n + c_b A dt / m] / |v_t|), so it can stop a particle
/// but never turn it round, and sticking is exact.
struct ContactLaw {
  double stiffness = 1;           ///< k [1/s^2], per mass
  double damping = 0;             ///< 2 zeta sqrt(k) [1/s]
  double contact_distance = 0.5;  ///< dx/2 [m]
  double friction = 0;            ///< mu (1 - r_u) [-]
  double cohesion_rate = 0;       ///< c_b A / m [m/s^2], for particles within `cohesion_distance`
  double cohesion_distance = 0;   ///< [m]
};

/// Damping ratio of a restitution: zeta = -ln e / sqrt(pi^2 + ln^2 e).
inline double damping_ratio(double restitution) {
  const double l = std::log(restitution > 1e-6 ? restitution : 1e-6);
  return -l / std::sqrt(9.869604401089358 + l * l);
}

/// Energies per unit mass [J/kg]; works are on the particle, friction is what it lost. Taken with
/// the mean of the velocities before the step and after the contact, so rest costs nothing.
struct ContactEnergy {
  double pressure_work = 0, contact_work = 0, friction = 0, spring = 0;
};

/// Applies one contact to a velocity.
/// \param distance  to the surface along its normal, may be negative      [m]
/// \param nx,ny,nz  unit normal into the free side
/// \param pressure_acceleration  mirrored pressure of the wall, >= 0 [m/s^2]
/// \param before    velocity at the start of the step                      [m/s]
/// \param vx,vy,vz  in and out                                             [m/s]
inline ContactEnergy apply_contact(const ContactLaw& law, double distance, double nx, double ny,
                                   double nz, double pressure_acceleration, double dt,
                                   const double before[3], double& vx, double& vy, double& vz) {
  ContactEnergy energy;
  double vn = vx * nx + vy * ny + vz * nz;
  const double vn_before = vn;
  const double from_pressure = pressure_acceleration * dt;
  vn += from_pressure;
  double impulse = 0;
  const double overlap = law.contact_distance - distance;
  if (overlap > 0) {
    impulse = std::fmax(0.0, law.stiffness * overlap - law.damping * vn) * dt;
    energy.spring = 0.5 * law.stiffness * overlap * overlap;
    // A centre below the surface does not sink further, whatever the spring says.
    if (distance < 0) impulse = std::fmax(impulse, -vn);
    vn += impulse;
  }
  const double normal_impulse = from_pressure + impulse;  // every one enters the Coulomb cap
  double cap = law.friction * normal_impulse;
  if (distance < law.cohesion_distance) cap += law.cohesion_rate * dt;
  const double tx = vx - vn_before * nx, ty = vy - vn_before * ny, tz = vz - vn_before * nz;
  const double speed2 = tx * tx + ty * ty + tz * tz;
  double keep = 1;
  if (cap > 0 && speed2 > 0) {
    keep = std::fmax(0.0, 1 - cap / std::sqrt(speed2));
  }
  vx = keep * tx + vn * nx;
  vy = keep * ty + vn * ny;
  vz = keep * tz + vn * nz;
  const double mx = 0.5 * (before[0] + vx), my = 0.5 * (before[1] + vy),
               mz = 0.5 * (before[2] + vz);
  const double mn = mx * nx + my * ny + mz * nz;
  energy.pressure_work = from_pressure * mn;
  energy.contact_work = impulse * mn;
  energy.friction = (1 - keep) * (tx * mx + ty * my + tz * mz);
  return energy;
}

}  // namespace sturz
