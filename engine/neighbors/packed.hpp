// SPDX-License-Identifier: Apache-2.0
/// The layout that the pair loop reads and writes: plain arrays, free of Eigen and std containers
/// because the loop is compiled once per instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sturz {

/// Particles per group: they sit in lanes while their common neighbours are broadcast.
inline constexpr int group_size = 16;

/// One particle as neighbour. Positions are fixed point (differences are exact however far the
/// scene's origin is); the unit is PackedView::unit_m.
struct alignas(64) PackedRecord {
  std::int32_t x, y, z;
  float volume;                 ///< m / rho [m^3]
  float vx, vy, vz;             ///< [m/s]
  float compression;            ///< rho / rho_ref - 1 [-]
  float sxx, syy, szz, sxy, syz, szx;  ///< stress, tension positive [Pa]
  float inverse_pressure;       ///< 1/(p + p_c), see SweepConstants::stress_smoothing [1/Pa]
  float spare;
};
static_assert(sizeof(PackedRecord) == 64);

/// Everything a sweep needs to read. Group g holds particles g*16 .. g*16+15 of storage order;
/// records n_particles .. n_records-1 are periodic images and padding.
struct PackedView {
  const PackedRecord* records = nullptr;
  std::size_t n_particles = 0;
  const std::uint32_t* list_begin = nullptr;  ///< [n_groups + 1] into list
  const std::uint32_t* list = nullptr;        ///< record numbers
  double unit_m = 1;                          ///< metres per position unit
};

/// Constants of the dense pair terms.
struct SweepConstants {
  double h = 1;                  ///< smoothing length [m]
  double gradient_factor = 1;    ///< C of SmoothingKernel
  double reference_density = 1;  ///< [kg/m^3]
  double sound_speed = 1;        ///< c0 [m/s]
  double viscosity = 0.1;        ///< alpha_v
  double density_diffusion = 0.1;///< delta
  double stress_smoothing = 0;   ///< zeta of the stress ratio s/(p + p_c); 0: not in this sweep
};

/// What walls add at each particle, [n_particles rounded up to whole groups] each; order
/// xx yy zz xy yz zx. The sweep takes it in the share n.M.n / 0.25 (at most 1) of the support that
/// neighbours give along the wall's normal: a grain with nothing above it has no pressure field to
/// be mirrored, and would bounce off its own image without loss.
struct BoundaryView {
  const float* moment[6];      ///< to the moment matrix [-]
  const float* gradient[6];    ///< to the velocity gradient before correction [1/s]
};

/// Results per particle, each [n_particles rounded up to whole groups].
struct SweepOutput {
  float* ax;  float* ay;  float* az;   ///< acceleration by stress and artificial viscosity [m/s^2]
  float* lxx; float* lxy; float* lxz;  ///< corrected velocity gradient dv_a/dx_b [1/s]
  float* lyx; float* lyy; float* lyz;
  float* lzx; float* lzy; float* lzz;
  float* diffusion;                    ///< d(compression)/dt by delta-SPH [1/s]
  float* wall_share;                   ///< 0..1: how much of a wall's mirror image acts, see BoundaryView
  float* smooth[6];                    ///< d(s/(p + p_c))/dt, written when stress_smoothing > 0 [1/s]
};

}  // namespace sturz
