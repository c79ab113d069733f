// SPDX-License-Identifier: Apache-2.0
/// How a member came through its run, and what every member must keep whatever its scene.
#pragma once

#include "engine/simulation/parts.hpp"
#include "engine/simulation/simulation.hpp"
#include "tests/hard/hard_case.hpp"

#include <functional>
#include <string>
#include <vector>

namespace sturz::test {

/// What is seen every 16 steps of a member and at its end.
struct Survival {
  Outcome outcome = Outcome::failed;
  std::string reason;
  bool finite = false;  ///< every position and velocity at the end
  double particles = 0, steps = 0, end_time_s = 0, seconds = 0;
  double front_travel_m = 0, max_mach = 0;
  /// |unexplained| over the most that was released at any time. A mass in a hollow settles, then
  /// swells a little: what it has released at the end may be next to nothing.
  double energy_residual = 0;
  double reported_residual = 0;  ///< the same over what was released at the end
  /// Dissipated by artificial viscosity and the mismatch of discrete gradients, over the same;
  /// negative where the law takes more than the motion gives.
  double numerical_share = 0;
  double mass_error = 0;    ///< |kept + lost - released| / released
  double leaked_share = 0;  ///< of the released mass: found under the ground
  double cold = 0;          ///< grains seen with a granular temperature below zero or NaN
  double lost_share = 0;    ///< of the released mass: left over the domain boundary, or leaked
  double lowest_dx = 0;     ///< lowest centre above the ground, at any time looked at
  double free_fall = 0;     ///< sqrt(v0^2 + 2 g drop) [m/s]
  double speed_ratio = 0;   ///< fastest particle / that
  double mean_dt_ratio = 0, least_dt_ratio = 0;  ///< over the estimate before the run
  double kinetic_ratio = 0;                      ///< kinetic energy at the end / at its peak
  /// Energy that is there (kinetic, stored, in springs, gone with mass) or known to be spent
  /// (yielding, friction, damping, collisions) beyond what start and gravity gave, over the same:
  /// the most at any time. What friction takes does not pay for what a wrong force makes. Left out:
  /// what density diffusion and changes of the sound speed are known to add (Ledger::diffusion
  /// where positive).
  double created_energy = 0;
  /// Growth of the kinetic energy in the last tenth of the time less what gravity gave, over the
  /// peak: a mass may still fall at the end, but nothing else may speed it up.
  double late_growth = 0;
};

/// Runs a simulation to its stop.
/// \param start_speed  of the release [m/s]
/// \param estimated_dt  of describe(); 0: ratios of the step stay zero and are not checked [s]
/// \param also  looked at when the run is
Survival survive(Simulation, double start_speed, double estimated_dt,
                 const std::function<void(const SimulationParts&)>& also = {});

/// The figures against their bounds:
///   named outcome, finite numbers, mass error 1e-12, nothing leaked  exact, but for rounding
///   energy residual 1 %         docs/physics.md V20
///   centres 0.1 dx under ground  as in the leak tests (I3)
///   energy created 1 %           as the residual
///   speed 1.05 of free fall      of the fastest particle; the margin is for what is looked at in
///                                between. A mass that splashes may jet: `jets` leaves this one out
///   mean step 0.05 of estimate   a member may take 20 times as long as announced, not more
std::vector<Check> checks_of(const Survival&, bool jets = false);

}  // namespace sturz::test
