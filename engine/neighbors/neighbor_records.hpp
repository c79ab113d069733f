// SPDX-License-Identifier: Apache-2.0
/// The layout that the pair loop reads and writes: plain arrays, free of Eigen and std containers
/// because the loop is compiled once per instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sturz {

/// Particles per group: they sit in lanes while their common neighbours are broadcast.
inline constexpr int group_size = 16;
/// Groups whose lists are kept together, see NeighborView.
inline constexpr std::size_t groups_per_block = 32;

/// One particle as neighbour. Positions are fixed point (differences are exact however far the
/// scene's origin is); the unit is NeighborView::unit_m.
struct alignas(64) NeighborRecord {
  std::int32_t x, y, z;
  float volume;                        ///< m / rho [m^3]
  float vx, vy, vz;                    ///< [m/s]
  float density_change;                ///< rho / rho_ref - 1 [-]
  float sxx, syy, szz, sxy, syz, szx;  ///< stress, tension positive [Pa]
  float viscosity;                     ///< share of the artificial viscosity that acts [-]
  float tension;  ///< artificial pressure against clumps in tension [Pa], see TensionSums

  /// Of a liquid, which has no such pressure: how much of `viscosity` stands for its own and is
  /// held by a bed that does not slip [-]. The rest is there for noise and slips along the ground.
  float& held_viscosity() { return tension; }
  float held_viscosity() const { return tension; }
};
static_assert(sizeof(NeighborRecord) == 64);

/// What a dispersed grain brings besides its NeighborRecord (B.6, B.9). The
/// record's volume and stress are those of enduring contacts, which dilated grains do
/// not have; kinetic stresses act on the volume that the grains really take up.
struct alignas(16) KineticRecord {
  float dilation_ratio = 1;  ///< true volume over NeighborRecord::volume [-]
  /// Replaces `dilation_ratio` in pairs: sqrt(dilation_ratio/support_completeness) makes the sums
  /// over a cloud's few neighbours complete, and keeps pairs symmetric.
  float weight = 1;
  float xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;  ///< kinetic stress, tension positive [Pa]
  float theta = 0;                                       ///< granular temperature [m^2/s^2]
  float resistance = 1e30f;  ///< 1/k_theta; huge: no conduction [m s/kg]
  float viscosity = 1;       ///< replaces NeighborRecord::viscosity [-]
  float spare = 0;
};
static_assert(sizeof(KineticRecord) == 48);

/// Where a grain lies against the ground, by record: a neighbour is mirrored at its own distance.
struct GroundRecord {
  static constexpr float far = 8;  ///< of `distance` in supports: no image reaches anything
  float distance;  ///< to the ground, >= 0, in position units; `far` supports from 2h on
  /// 0..1, of the step before: how much of the grain's image acts, see BoundaryView.
  float weight;
};

/// Half the gradient of the density change per position unit, of the step before, by record.
struct alignas(16) HalfDensityGradient {
  float x = 0, y = 0, z = 0, spare = 0;
};

/// Everything a sweep needs to read. Group g holds particles g*16 .. g*16+15 of storage order;
/// records n_particles .. n_records-1 are periodic images and padding.
struct NeighborView {
  const NeighborRecord* records = nullptr;
  std::size_t n_particles = 0;
  /// Record numbers near group g: from list(g) to list(g) + list_size(g). Lists are kept in blocks
  /// of `groups_per_block` groups; list_end[g] counts from the start of g's block.
  const std::uint32_t* const* block = nullptr;
  const std::uint32_t* list_end = nullptr;
  double unit_m = 1;                                      ///< metres per position unit
  const HalfDensityGradient* density_gradient = nullptr;  ///< by record

  std::size_t list_start(std::size_t g) const { return g % groups_per_block ? list_end[g - 1] : 0; }
  const std::uint32_t* list(std::size_t g) const {
    return block[g / groups_per_block] + list_start(g);
  }
  std::size_t list_size(std::size_t g) const { return list_end[g] - list_start(g); }
};

/// Constants of the dense pair terms.
struct SweepConstants {
  double h = 1;                    ///< smoothing length [m]
  double gradient_factor = 1;      ///< C of SmoothingKernel
  double reference_density = 1;    ///< [kg/m^3]
  double sound_speed = 1;          ///< c0 [m/s]
  double viscosity = 0.1;          ///< alpha_v
  double density_diffusion = 0.1;  ///< delta
  bool tension = false;            ///< whether NeighborRecord::tension is in this sweep
  double spacing = 1;              ///< initial particle spacing dx [m]; read where tension is
  double stress_smoothing = 0;     ///< zeta of the stress ratio s/(p + p_c); 0: not in this sweep
  double ratio_floor = 0;          ///< p_c [Pa]; read where the ratio is smoothed
};

/// Ground and walls at each particle, [n_particles rounded up to whole groups] each but `ground`.
///
/// At the ground all neighbours within the support are mirrored, each with the product of both
/// grains' weights; at analytic walls the grain alone, in closed form. The weight is n.M.n / 0.25
/// (at most 1) of the support that neighbours give along the normal: a grain with nothing above it
/// has no pressure field to be mirrored, and would bounce off its own mirror image without loss.
struct BoundaryView {
  const GroundRecord* ground;  ///< by record
  const float *nx, *ny, *nz;   ///< the ground's normal, finite everywhere
  /// What analytic walls add, order xx yy zz xy yz zx; null where there are none.
  const float* moment[6];    ///< to the moment matrix [-]
  const float* gradient[6];  ///< to the velocity gradient before correction [1/s]
  /// Whether the ground holds what lies on it (a liquid): see sweep/no_slip_sums.hpp. Read by the
  /// dense sweep.
  bool no_slip = false;
};

/// How long a sweep spends on groups in which some grain is dispersed or has a dispersed neighbour.
/// A function of the caller because headers of the library must not be compiled for one instruction
/// set.
struct DispersedClock {
  std::int64_t (*now_ns)() = nullptr;
  std::int64_t spent_ns = 0;  ///< added to
};

/// For a mass whose grains may disperse.
struct KineticView {
  const KineticRecord* records = nullptr;  ///< as many as NeighborView::records
  const std::uint8_t* dense_group =
      nullptr;                      ///< by record/group_size: 1 where no grain is dispersed
  DispersedClock* clock = nullptr;  ///< may be null
};

/// Results per particle, each [n_particles rounded up to whole groups].
struct SweepOutput {
  float* ax;
  float* ay;
  float* az;  ///< acceleration by stress and artificial viscosity [m/s^2]
  float* lxx;
  float* lxy;
  float* lxz;  ///< corrected velocity gradient dv_a/dx_b [1/s]
  float* lyx;
  float* lyy;
  float* lyz;
  float* lzx;
  float* lzy;
  float* lzz;
  float* diffusion;            ///< d(density_change)/dt by delta-SPH [1/s]
  float* density_gradient[3];  ///< of the density change, for the next step [1/m]
  /// Acceleration by the images in the ground [m/s^2]; its part along the ground is in ax, ay, az,
  /// too. Not written for groups beyond 2h of it.
  float* from_ground[3];
  float* ground_weight;  ///< 0..1: how much of the grain's image acts in the next step
  /// 0..1: how much of the walls' mirror contribution acts; written where there are walls.
  float* mirror_weight;
  /// Written where a KineticView is given: how full the support is of neighbours and ground (1
  /// inside a dense mass, about a half at its surface), how many neighbours there are, and the
  /// granular energy that is conducted to it per volume of the record [W/m^3].
  float *support_completeness, *neighbors, *conducted;
  /// Symmetric velocity gradient consistent with the pair forces of kinetic stresses, xx yy zz xy
  /// yz zx: their work on the motion is V sigma_k : this, exactly [1/s].
  float* pair_gradient[6];
  static constexpr float uncounted = 1000;  ///< neighbours of a grain far from dispersed ones
  float* smooth[6];  ///< d(s/(p + p_c))/dt, written when stress_smoothing > 0 [1/s]
};

}  // namespace sturz
