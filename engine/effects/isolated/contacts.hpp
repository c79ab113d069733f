// SPDX-License-Identifier: Apache-2.0
/// Isolated particles that hit each other: Hertz-Mindlin contacts in steps of their own.
#pragma once

#include "engine/effects/step.hpp"
#include "engine/laws/hertz_mindlin.hpp"

namespace sturz {

struct IsolatedContactSettings {
  GrainMaterial material;        ///< of the grains; E is softened for `speed_bound`
  double restitution = 0.7;      ///< e [-]
  double friction = 0.5;         ///< mu_c [-]
  double speed_bound = 40;       ///< the fastest approach expected [m/s]; faster overlaps more
  double greatest_share = 0.05;  ///< overlap of such an impact over the radius [-]
  bool never_pulls = false;      ///< see ContactPair
  /// The ground as another partner: a plane through the point of BoundarySupport, of the same
  /// material. By default isolated particles have the ground of `terrain_contact` like all others
  /// (B.9); one of the two must be off for them. Spheres roll: nothing slows them on
  /// even ground.
  bool on_ground = false;
  double ground_restitution = 0.2;  ///< [-]
  double ground_friction = 0.4;     ///< [-]
};

/// Adds the contacts of the particles from MovingSet::n_listed on, each a sphere of its own mass
/// and the grains' density: diameter (6 m/(pi rho_p))^(1/3) (B.9), with the field "spin"
/// (3) [rad/s]. To be added after `add_terrain_contact`, whose impulses come first.
///
/// Only particles that touch within the step, and those near them, are stepped finely, in
/// n = ceil(dt / min(0.2 T_R, t_c/20)) steps of velocity Verlet; their position is handed on such
/// that the drift of the step ends where the fine steps ended. The others are not touched at all.
///
/// What a particle overlaps at the moment it becomes isolated carries no load until it has opened,
/// so becoming isolated sets no energy free (ContactMemory).
///
/// Ledger: contact_work and isolated_work, rotational, isolated_elastic. Serial, in the order of
/// ids.
void add_isolated_contacts(Step&, State&, std::size_t set, const IsolatedContactSettings&);

}  // namespace sturz
