// SPDX-License-Identifier: Apache-2.0
/// Blocks of particles on an inclined plane, as the pair sweep sees them.
#pragma once

#include "tests/support/sweep/sweep_scene.hpp"

#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace sturz::test {

/// Two tangents and the normal of an inclined plane through the origin, in rows.
inline Eigen::Matrix3d tilted_frame() {
  const Vec3 n = Vec3(-0.4, 0.1, 1).normalized();
  Eigen::Matrix3d frame;
  frame.row(2) = n;
  frame.row(0) = Vec3(n.z(), 0, -n.x()).normalized();
  frame.row(1) = n.cross(Vec3(frame.row(0)));
  return frame;
}

/// n[2] layers on the inclined plane, the lowest half a spacing above it.
inline std::vector<SlowParticle> block_on_ground(std::array<int, 3> n, double dx, double jitter) {
  const Eigen::Matrix3d frame = tilted_frame();
  auto cloud = lattice(n, dx, jitter);
  for (SlowParticle& p : cloud) {
    p.position = frame.transpose() * (p.position + Vec3(0, 0, 0.5 * n[2] * dx));
    p.ground_normal = frame.row(2);
    p.ground_distance = p.position.dot(p.ground_normal);
  }
  return cloud;
}

/// The same with everything at random, the weights of the images too.
inline std::vector<SlowParticle> rough_block_on_ground(double dx) {
  auto cloud = block_on_ground({11, 10, 7}, dx, 0.2);
  roughen(cloud, dx);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  for (SlowParticle& p : cloud) {
    p.ground_weight = 0.6 + 0.4 * u(random);
    p.density_gradient = 1e-3 * Vec3(u(random), u(random), u(random));
  }
  return cloud;
}

inline double mass_of(const SlowParticle& p, const SweepConstants& c) {
  return p.volume * c.reference_density * (1 + p.density_change);
}

/// What the images in the ground do to the motion, and what their part of the strain takes from it.
struct ImagesWork {
  double work = 0, power = 0;  ///< sums over the particles [W]
  double size = 0;             ///< sum of the works' sizes [W]
};
/// \param c  without artificial viscosity, which is no part of the stress
inline ImagesWork work_of_images(const std::vector<SlowParticle>& cloud, const SweepConstants& c,
                                 bool no_slip) {
  auto airborne = cloud;
  for (SlowParticle& p : airborne) p.ground_distance = 1e9;
  const auto with = slow_sweep(cloud, {}, c, false, no_slip);
  const auto without = slow_sweep(airborne, {}, c);
  const auto fast = fast_sweep(cloud, c, best_instruction_set(), {}, no_slip).rates;
  ImagesWork sum;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const SlowParticle& p = cloud[i];
    const double done = mass_of(p, c) * fast[i].from_ground.dot(p.velocity);
    sum.work += done;
    sum.size += std::abs(done);
    sum.power += p.volume * p.stress.cwiseProduct(with[i].pair_sums - without[i].pair_sums).sum();
  }
  return sum;
}

/// What the images have a part in, with names.
inline const std::vector<std::pair<const char*, Eigen::MatrixXd (*)(const SlowRates&)>>&
parts_with_images() {
  static const std::vector<std::pair<const char*, Eigen::MatrixXd (*)(const SlowRates&)>> parts{
      {"acceleration", [](const SlowRates& r) -> Eigen::MatrixXd { return r.acceleration; }},
      {"from ground", [](const SlowRates& r) -> Eigen::MatrixXd { return r.from_ground; }},
      {"gradient", [](const SlowRates& r) -> Eigen::MatrixXd { return r.gradient; }},
      {"ground weight",
       [](const SlowRates& r) -> Eigen::MatrixXd { return Vec3(r.ground_weight, 0, 0); }},
      {"density gradient",
       [](const SlowRates& r) -> Eigen::MatrixXd { return r.density_gradient; }},
      {"diffusion", [](const SlowRates& r) -> Eigen::MatrixXd { return Vec3(r.diffusion, 0, 0); }}};
  return parts;
}

}  // namespace sturz::test
