// SPDX-License-Identifier: Apache-2.0
/// What a pass may touch: the particles, the ground, the clock and the books.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/core/ledger.hpp"
#include "engine/particles/particle_set.hpp"
#include "engine/terrain/terrain.hpp"

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
/// A wall cuts the support of the particles beside it. The missing half is taken as their mirror
/// image: same stress, same tangential and opposite normal velocity. Momentum then gains
/// 2 p_n W_plane(d)/rho along n, the velocity gradient 2 W_plane(d) v_n n (x) n, and the moment
/// matrix 2 d W_plane(d) n (x) n, which keeps linear fields without flow through the wall exact
/// (shear along the normal is felt too weakly in the last two layers). Force and strain are
/// adjoint, so a bouncing column neither gains nor loses energy at the wall.
struct BoundarySupport {
  std::vector<float> distance;    ///< to the ground along its normal; beyond 2h no more than it [m]
  std::vector<float> nx, ny, nz;  ///< that normal, up to date within 2h
  std::vector<float> share;       ///< 0..1, from the sweep: how much of the image acts
  std::vector<float> moment[6];   ///< of analytic walls, xx yy zz xy yz zx [-]; empty without walls
  std::vector<float> gradient[6];  ///< the same order [1/s]
};

struct State {
  ParticleSet grains;
  Terrain terrain;
  Domain domain;
  double gravity = 9.81;   ///< [m/s^2], along -z
  double time = 0;         ///< [s]
  double sound_speed = 0;  ///< c0 at present; 0: nothing sounds [m/s]
  double previous_dt = 0;  ///< of the last step [s]; 0 before the first
  std::size_t n_steps = 0;
  int threads = 1;

  std::vector<float> ax, ay, az;      ///< acceleration of the force stage, at least [n] [m/s^2]
  std::vector<std::uint8_t> outside;  ///< 1: off the known terrain, 2: lost under the ground
  bool any_outside = false;
  bool corrupt = false;  ///< a position was not finite: it must not count as lost
  /// What wrapping into the periods took off each particle's map position, by id [m]; empty
  /// where nothing is periodic.
  std::vector<double> wrapped_x, wrapped_y;
  bool order_changed = true;  ///< particles were added, removed or moved by force
  /// Particles [0, n_listed) are grains of the continuum, the rest lone parcels in flight. Up to
  /// date from the neighbour stage of a step to its end.
  std::size_t n_listed = 0;
  double hottest = 0;       ///< largest granular temperature so far [m^2/s^2]
  std::size_t n_sorts = 0;  ///< how often the storage order was made anew
  BoundarySupport boundary;
  MotionBounds motion;
  Ledger ledger;

  /// Whether the move stage removes particle i: off a rim that lets mass out, or underground.
  bool leaves(std::size_t i) const {
    return outside[i] == 2 || (outside[i] == 1 && terrain.nodata_rule() == NodataRule::outflow);
  }
  /// Factor that extrapolates the last change of velocity to v_{n+1/2}; see predicted_velocity.
  double extrapolation(double dt) const { return previous_dt > 0 ? dt / previous_dt : 0; }

  State(Terrain ground, Domain bounds) : terrain(std::move(ground)), domain(std::move(bounds)) {}
};

}  // namespace sturz
