// SPDX-License-Identifier: Apache-2.0
/// Where mass, momentum and energy of a member went; every pass accounts for what it did.
#pragma once

#include "engine/core/vec.hpp"

#include <iterator>

namespace sturz {

/// Energies in J, dissipation positive; impulses in N s; mass in kg.
///
/// Kinetic energy changes only through accounted works:
///   d(kinetic) = gravity_work + stress_work + contact_work - friction - rest_damping -
///   lost_energy - taken_energy + added_energy - entrainment_loss - drag_loss + exchange_work +
///   outer_work.
/// stress_work = -(stress_power + numerical): what the pair forces take from the motion is either
/// stored or dissipated by the constitutive law (stress_power), or went into artificial viscosity
/// and the mismatch of discrete gradients (numerical). Where grains lie in a liquid, its pair
/// forces are those of the mixture: a part of their work, exchange_work, is done on the grains.
/// contact_work = -(spring change + damping), and among isolated particles -(change of rotational
/// and isolated_elastic + isolated_dissipated).
struct Ledger {
  double released_mass = 0, lost_mass = 0, leaked_mass = 0;  ///< leaked: found under the ground
  double added_mass = 0, taken_mass = 0;                     ///< by effects, after the release
  double added_energy = 0, taken_energy = 0;                 ///< kinetic energy that went with it
  double added_volume = 0;      ///< bulk, of added mass that has one [m^3]
  double entrained_mass = 0;    ///< taken up of the bed, at rest until then
  double entrainment_loss = 0;  ///< of kinetic energy, by mixing with it
  double drag_loss = 0;         ///< of kinetic energy, by drag between two sets
  /// Mass times time at which drag was raised to keep two velocities solvable [kg s].
  double drag_raised = 0;
  double exchange_work = 0;  ///< on grains, by their share of the liquid's stress
  double outer_work = 0;  ///< by what nothing below names: effects such as wind, ground that moves

  /// Now. Potential is the accounted change since release: it counts what left as it was when it
  /// left, and a periodic image's jump not at all.
  double kinetic = 0, potential = 0, elastic = 0, spring = 0;
  double kinetic_0 = 0, elastic_0 = 0, spring_0 = 0;  ///< at release

  double gravity_work = 0;
  double stress_work = 0;    ///< by pair forces and the mirrored pressure of walls
  double stress_power = 0;   ///< integral of V sigma : D
  double frictional = 0;     ///< stored by the frictional pressure of grains that separate
  double granular = 0;       ///< of granular temperature, now
  double conducted = 0;      ///< gained by its conduction: zero but for rounding
  double collisions = 0;     ///< dissipated by collisions of grains
  double granular_lost = 0;  ///< with grains that left the continuum, less what came back
  double plastic = 0;        ///< dissipated by yielding of grains and flow of a liquid
  double diffusion = 0;      ///< elastic energy added by density diffusion and stress smoothing
  double contact_work = 0;  ///< by contact springs, dampers and the ground guard, isolated_work too
  double isolated_work = 0;  ///< by contacts of isolated particles, on their flight
  /// Now: spins of isolated particles, springs of their contacts.
  double rotational = 0, isolated_elastic = 0;
  double friction = 0;      ///< dissipated by Coulomb friction and cohesion at the bed
  double rest_damping = 0;  ///< dissipated below the speed of rest (docs/physics.md I4)
  double lost_energy =
      0;  ///< kinetic and elastic energy that left or was taken by the domain boundary

  double detachment =
      0;  ///< mass times time on ground that curves away faster than it falls [kg s]

  double released_solids = 0, lost_solids = 0;  ///< grains of a mixture [m^3]
  double released_water = 0, lost_water = 0;    ///< water in its pores and on it [m^3]
  /// Elastic energy of pore pressures that their bounds cut off (docs/physics.md F.7).
  double clipped_work = 0;

  Vec3 added_momentum{0, 0, 0};  ///< of all that entered after the start
  /// Sum of m a dt of pair forces alone: zero but for rounding.
  Vec3 stress_impulse{0, 0, 0};
  double stress_impulse_scale = 0;  ///< sum of |m a dt|

  /// The accounts of another particle set beside these.
  Ledger& operator+=(const Ledger& other);

  /// Potential energy set free so far, plus what the mass started with [J].
  double released_energy() const { return kinetic_0 + elastic_0 - potential; }
  /// What was released and what came later, for shares of it [kg].
  double brought_mass() const { return released_mass + added_mass + entrained_mass; }
  /// Energy that shares are taken of [J].
  double available_energy() const { return released_energy() + added_energy; }
  /// Dissipated by artificial viscosity and discretisation; of grains and liquid together only,
  /// where the one works on the other.
  double numerical() const { return -stress_work - stress_power - exchange_work; }
  /// Dissipated in normal contact with ground and walls.
  double damping() const { return -(contact_work - isolated_work) - (spring - spring_0); }
  /// Dissipated by contacts of isolated particles, or lost with a particle that was pressed or
  /// spun.
  double isolated_dissipated() const { return -isolated_work - rotational - isolated_elastic; }
  /// Energy that no account explains [J]: time integration of gravity and of the stress law.
  double residual() const {
    return (kinetic - kinetic_0) + potential + (elastic - elastic_0) + (spring - spring_0) +
           frictional + granular + collisions - conducted + granular_lost + plastic + friction +
           rest_damping + damping() + rotational + isolated_elastic + isolated_dissipated() +
           numerical() - diffusion + lost_energy + taken_energy - added_energy + entrainment_loss +
           drag_loss - outer_work;
  }
};

inline Ledger& Ledger::operator+=(const Ledger& other) {
  using Entry = double Ledger::*;
  constexpr Entry entries[] = {&Ledger::released_mass,    &Ledger::lost_mass,
                               &Ledger::leaked_mass,      &Ledger::added_mass,
                               &Ledger::added_energy,     &Ledger::kinetic,
                               &Ledger::taken_mass,       &Ledger::taken_energy,
                               &Ledger::potential,        &Ledger::elastic,
                               &Ledger::spring,           &Ledger::kinetic_0,
                               &Ledger::elastic_0,        &Ledger::spring_0,
                               &Ledger::gravity_work,     &Ledger::outer_work,
                               &Ledger::stress_work,      &Ledger::stress_power,
                               &Ledger::frictional,       &Ledger::granular,
                               &Ledger::conducted,        &Ledger::collisions,
                               &Ledger::granular_lost,    &Ledger::plastic,
                               &Ledger::diffusion,        &Ledger::contact_work,
                               &Ledger::isolated_work,    &Ledger::rotational,
                               &Ledger::isolated_elastic, &Ledger::friction,
                               &Ledger::rest_damping,     &Ledger::lost_energy,
                               &Ledger::detachment,       &Ledger::stress_impulse_scale,
                               &Ledger::released_solids,  &Ledger::lost_solids,
                               &Ledger::released_water,   &Ledger::lost_water,
                               &Ledger::clipped_work,     &Ledger::entrained_mass,
                               &Ledger::entrainment_loss, &Ledger::drag_loss,
                               &Ledger::drag_raised,      &Ledger::added_volume,
                               &Ledger::exchange_work};
  // An entry that is added above but forgotten here would silently miss from every total.
  static_assert(sizeof(Ledger) == (std::size(entries) + 6) * sizeof(double));
  for (const Entry entry : entries) this->*entry += other.*entry;
  stress_impulse += other.stress_impulse;
  added_momentum += other.added_momentum;
  return *this;
}

}  // namespace sturz
