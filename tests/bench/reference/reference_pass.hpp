// SPDX-License-Identifier: Apache-2.0
/// The hot loops of the reference step: the fewest lines that do the same physics, in float.
///
/// Included by files that are compiled for this very processor, so it holds plain data only.
///
/// Left out against the engine: the gradient's correction (moment matrix), density diffusion,
/// stress smoothing, the mirror image at the ground, drag at rest, dilated grains, cohesion, walls,
/// periods, zones, losses over the domain boundary, the energy ledger, double precision of the
/// state, sums whose bits do not depend on threads, limits of the time step, peak maps and the stop
/// rule.
#pragma once

#include <cstddef>

namespace sturz::bench {

/// Floats of a neighbour's record, one cache line: x y z V vx vy vz - xx yy zz xy yz zx - -.
inline constexpr int record_floats = 16;

struct ReferenceNumbers {
  float h, gradient_factor;  ///< smoothing length [m], C of grad W = -C t^3 r
  float density, sound_speed, viscosity;
  float bulk, shear;  ///< K, G [Pa]
  float static_friction, dynamic_friction;
  float slowness;  ///< G I_0 / (d_p sqrt(rho_p)) [Pa^(1/2)/s]
  float gravity;
  float spring, damping, contact_distance,
      basal_friction;  ///< of the ground [1/s^2], [1/s], [m], [-]
};

/// Nodes of the ground; node (0, 0) in the south-west.
struct ReferenceGround {
  const float* z;
  int n_cols, n_rows;
  float west, south, cell;
};

/// Columns of the particles, all [n].
struct ReferenceColumns {
  std::size_t n;
  float *x, *y, *z, *vx, *vy, *vz, *mass, *density_change, *ax, *ay, *az;
  float *stress[6], *gradient[9];  ///< xx yy zz xy yz zx; dv_a/dx_b row by row
};

/// Neighbours: offsets of their records, 16 j, of particle i at begin[i] .. begin[i + 1].
struct ReferenceList {
  const float* records;
  const int* begin;
  const int* offsets;
};

/// The loops as one compilation made them.
struct ReferencePass {
  const char* name;
  /// Writes the records.
  void (*gather_records)(const ReferenceColumns&, const ReferenceNumbers&, float* records);
  /// One pass over the lists: velocity gradient, stress force, artificial viscosity.
  void (*sum_pairs)(const ReferenceColumns&, const ReferenceNumbers&, const ReferenceList&);
  /// Continuity, then elastic + mu(I) with the stress turned along (Jaumann), then the kick.
  void (*update_particles)(const ReferenceColumns&, const ReferenceNumbers&, float dt);
  /// Spring, damper and Coulomb friction of a bilinear ground.
  void (*meet_ground)(const ReferenceColumns&, const ReferenceNumbers&, const ReferenceGround&,
                      float dt);
  /// x += v dt. \return the diagonal of the box of velocities [m/s]
  float (*drift)(const ReferenceColumns&, float dt);
};

/// Both for this very processor: vectors as wide as it has, filled by its gather instructions; and
/// vectors of 32 bytes filled float by float. Which is faster differs by a factor of two either
/// way, so their user tries both.
extern const ReferencePass reference_gathers, reference_single_loads;

}  // namespace sturz::bench
