// SPDX-License-Identifier: Apache-2.0
/// The slow twin of the pair sweep: every pair, double precision, the formulas of Part B in full.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/neighbors/neighbor_records.hpp"

#include <Eigen/Dense>

#include <vector>

namespace sturz::test {

/// A particle as the sweep sees it, positions in metres.
struct SlowParticle {
  Vec3 position{0, 0, 0}, velocity{0, 0, 0};
  double volume = 1;                                 ///< m/rho [m^3]
  double density_change = 0;                         ///< rho/rho_ref - 1
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();  ///< [Pa], tension positive
  double viscosity_share = 1;                        ///< of the artificial viscosity that acts
  double held_viscosity = 0;  ///< the part of it that a bed holds, see NeighborRecord
  Eigen::Matrix3d wall_moment = Eigen::Matrix3d::Zero();    ///< what walls add [-]
  Eigen::Matrix3d wall_gradient = Eigen::Matrix3d::Zero();  ///< [1/s]
  double ground_distance = 1e9;                             ///< [m]
  Vec3 ground_normal{0, 0, 1};
  double ground_weight = 1;        ///< of its image, from the step before
  Vec3 density_gradient{0, 0, 0};  ///< from the step before [1/m]
  // For dispersed grains, see KineticRecord:
  double tension = 0;  ///< artificial pressure [Pa]
  double dilation_ratio = 1, weight = 1, theta = 0, conductivity = 1e-30;
  Eigen::Matrix3d kinetic_stress = Eigen::Matrix3d::Zero();  ///< [Pa]
};

struct SlowRates {
  Vec3 acceleration{0, 0, 0};
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();   ///< corrected dv_a/dx_b
  Eigen::Matrix3d pair_sums = Eigen::Matrix3d::Zero();  ///< the same, not corrected; twin only
  Vec3 from_ground{0, 0, 0};  ///< acceleration by the images in the ground
  double ground_weight = 0;   ///< for the next step
  double diffusion = 0;
  Vec3 density_gradient{0, 0, 0};
  double mirror_weight = 0;  ///< of walls' mirror contribution
  Eigen::Matrix3d smoothing = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d pair_gradient =
      Eigen::Matrix3d::Zero();  ///< symmetric gradient of the kinetic force
  double conducted = 0;  ///< conducted granular energy, per volume that the grain takes up [W/m^3]
  double support_completeness = 0;  ///< a third of the moment's trace
  int neighbors = 0;
  bool corrected = true;  ///< false where the moment matrix is too poor and B = I
};

/// B.2, B.3, B.4 over all pairs. \param images extra particles that are neighbours only;
/// \param clouds  the gradient's correction as kinetic groups have it
/// \param no_slip  the ground holds what lies on it, see BoundaryView
std::vector<SlowRates> slow_sweep(const std::vector<SlowParticle>& particles,
                                  const std::vector<SlowParticle>& images, const SweepConstants&,
                                  bool clouds = false, bool no_slip = false);

}  // namespace sturz::test
