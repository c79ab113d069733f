// SPDX-License-Identifier: Apache-2.0
/// A particle set in motion: the particles and what a step keeps for them. A scene with a second
/// set (a liquid, grains of another size) has one more of these and nothing else changes.
#pragma once

#include "engine/core/ledger.hpp"
#include "engine/core/vec.hpp"
#include "engine/particles/particle_set.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace sturz {

/// Extremes of the motion, refreshed at the end of every step.
struct MotionBounds {
  double max_speed = 0;         ///< [m/s]
  double max_acceleration = 0;  ///< change of velocity over the step, contact included [m/s^2]
  double velocity_range[3] = {0, 0, 0};  ///< largest minus smallest component [m/s]
  bool finite = true;                    ///< false once any position or velocity is NaN or infinite
};

/// Ground and walls as seen by each particle at x_n; all arrays [n rounded up to whole groups].
///
/// Both cut the support of the particles beside them. The ground mirrors every neighbour: same
/// stress, same tangential and opposite normal velocity (sweep/image_sums.hpp). A
/// wall mirrors the particle itself: momentum gains 2 p_n W_plane(d)/rho along n, the velocity
/// gradient 2 W_plane(d) v_n n (x) n, and the moment matrix 2 d W_plane(d) n (x) n, which keeps
/// linear fields without flow through the wall exact (shear along the normal is too weak in the
/// last two layers). Force and strain are adjoint in both, so a bouncing column neither gains nor
/// loses energy.
struct BoundarySupport {
  std::vector<float> distance;    ///< to the ground along its normal; beyond 2h no more than it [m]
  std::vector<float> nx, ny, nz;  ///< that normal, up to date within 2h
  /// Acceleration by the images in the ground, from the sweep; up to date within 2h [m/s^2].
  std::vector<float> from_ground[3];
  std::vector<float> mirror_weight;  ///< 0..1, from the sweep: how much of walls' mirror acts
  std::vector<float> moment[6];  ///< of analytic walls, xx yy zz xy yz zx [-]; empty without walls
  std::vector<float> gradient[6];  ///< the same order [1/s]
  /// Whether the ground holds what lies on it (a liquid): its images are those of
  /// sweep/no_slip_sums.hpp.
  bool no_slip = false;
  /// Walls mirror all neighbours (NeighborLists::mirror_in) in the place of that closed form.
  bool mirrored_walls = false;
};

/// Why a particle is about to be taken out of its set.
enum class Fate : std::uint8_t {
  stays,
  off_terrain,  ///< beyond the known ground; leaves where the domain boundary lets mass out
  underground,  ///< lost below the surface
  /// An effect took it (deposited, detached, moved to another set); set with `any_leaving` by
  /// passes of the stages gather to stress, after the ground was looked up.
  taken,
};

/// A particle that an effect wants to add. What follows its mass is for columns.
struct Arrival {
  Vec3 position{0, 0, 0};  ///< [m]
  Vec3 velocity{0, 0, 0};  ///< [m/s]
  double mass = 0;         ///< [kg]
  double volume = 0;       ///< bulk; 0: its effect counts none [m^3]
  double thickness = 0;    ///< vertical; 0: what it gives itself [m]
  double covered = 1;      ///< share of its lattice cell that its source covers [-]
  double solid_fraction = std::numeric_limits<double>::quiet_NaN();  ///< NaN: that of the set [-]
  bool released = false;  ///< part of the release, which started later
};

/// A particle that crossed the edge of the known ground.
struct Departure {
  std::uint32_t id = 0;
  double x = 0, y = 0, z = 0;  ///< last place on known ground [m]
  double mass = 0;             ///< [kg]
};

struct MovingSet : ParticleSet {
  std::string name = "grains";
  double spacing = 1;             ///< initial particle spacing dx [m]
  double bulk_density = 1;        ///< of the mass as it was released [kg/m^3]
  double reference_fraction = 1;  ///< volume fraction of that bulk; 0 of a liquid, no grains [-]
  /// Share of that bulk that is its own volume on maps; less than 1 where another set has the rest.
  double filled_share = 1;
  double sound_speed = 0;  ///< numerical c0 at present; 0: nothing sounds [m/s]

  std::vector<float> ax, ay, az;  ///< acceleration of the force stage, at least [n] [m/s^2]
  std::vector<Fate> fate;         ///< [n] what the ground said; see State::leaves
  bool any_leaving = false;       ///< some fate is not `stays`
  bool corrupt = false;           ///< a position was not finite: it must not count as lost
  /// Where each particle entered, by id [m].
  std::vector<double> start_x, start_y;
  /// What wrapping into the periods took off each particle's map position, by id [m]; empty where
  /// nothing is periodic.
  std::vector<double> wrapped_x, wrapped_y;
  /// What mass that a particle took up on its way takes off the mean travel of its mass, by id [m];
  /// empty where none is taken up.
  std::vector<double> lag_x, lag_y;
  std::vector<Departure> departures;  ///< in the order in which they left
  bool order_changed = true;          ///< particles were added, removed or moved by force
  /// Particles [0, n_listed) are grains of the continuum, the rest isolated ones in flight. Up to
  /// date from the neighbour stage of a step to its end.
  std::size_t n_listed = 0;
  std::size_t n_sorts = 0;                  ///< how often the storage order was made anew
  double largest_granular_temperature = 0;  ///< so far [m^2/s^2]
  BoundarySupport boundary;
  MotionBounds motion;
  Ledger ledger;
  /// Particles that passes of this step want to add; they enter at its end.
  std::vector<Arrival> arrivals;
  /// Those that entered last, in storage order; for Pass::entered.
  std::vector<Arrival> entering;
  /// Particles that wait for their time to enter: of a later release, of an inflow that goes on.
  std::size_t to_come = 0;
};

}  // namespace sturz
