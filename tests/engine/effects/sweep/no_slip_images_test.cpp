// SPDX-License-Identifier: Apache-2.0
// A liquid's neighbours mirrored in a bed that holds it (docs/physics.md B.10).
#include "tests/engine/effects/sweep/ground_block.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace sturz {
namespace {

using Eigen::Matrix3d;
using test::mass_of;
using test::SlowParticle;
using test::tilted_frame;

constexpr double dx = 1.5;
constexpr bool held = true, slips = false;

/// At random, a part of each particle's viscosity held.
std::vector<SlowParticle> rough_block() {
  auto cloud = test::rough_block_on_ground(dx);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud[i].held_viscosity = (i % 4) / 3.0 * cloud[i].viscosity_share;
  return cloud;
}

InstructionSet fastest() { return best_instruction_set(); }

TEST(NoSlipImages, EqualTheSlowTwin) {
  const auto constants = test::usual_constants(dx);
  const auto cloud = rough_block();
  const auto slow = test::slow_sweep(cloud, {}, constants, false, held);
  for (auto isa : {InstructionSet::plain, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!supports(isa)) continue;
    const auto fast = test::fast_sweep(cloud, constants, isa, {}, held).rates;
    for (const auto& [name, part] : test::parts_with_images())
      EXPECT_LT(test::relative_error(fast, slow, part), 1e-5) << name << " " << to_string(isa);
  }
}

TEST(NoSlipImages, WideVectorsGiveTheSameBits) {
  if (!supports(InstructionSet::avx512)) GTEST_SKIP() << "this machine has no AVX-512";
  const auto constants = test::usual_constants(dx);
  for (int n : {1, 5, 16, 17, 700}) {
    auto cloud = rough_block();
    cloud.resize(n);
    const auto run = [&](InstructionSet isa) {
      return test::fast_sweep(cloud, constants, isa, {}, held).raw;
    };
    const auto narrow = run(InstructionSet::avx2), wide = run(InstructionSet::avx512);
    ASSERT_EQ(narrow.size(), wide.size());
    EXPECT_EQ(std::memcmp(narrow.data(), wide.data(), narrow.size() * sizeof(float)), 0) << n;
  }
}

/// Largest error of the velocity gradient of a shear flow above the plane, over that gradient, and
/// how many particles beside the bed were looked at.
struct ShearError {
  double largest = 0;
  int beside = 0;
};
ShearError shear_error(double spacing, double jitter, bool bed) {
  const auto constants = test::usual_constants(spacing);
  const Matrix3d frame = tilted_frame();
  Matrix3d local = Matrix3d::Zero();
  local(0, 2) = 1.3, local(1, 2) = -0.4, local(2, 2) = 0.2;  // v = a z of all three components
  const Matrix3d a = frame.transpose() * local * frame;
  auto cloud = test::block_on_ground({9, 9, 6}, spacing, jitter);
  for (SlowParticle& p : cloud) p.velocity = a * p.position;
  const auto slow = test::slow_sweep(cloud, {}, constants, false, bed);
  const auto fast = test::fast_sweep(cloud, constants, fastest(), {}, bed).rates;
  ShearError error;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!slow[i].corrected) continue;
    error.beside += cloud[i].ground_distance < 2 * constants.h;
    error.largest = std::max(error.largest, (fast[i].gradient - a).norm() / a.norm());
  }
  return error;
}

TEST(NoSlipImages, ShearAlongTheBedHasItsExactGradientInAnyDisorder) {
  for (const double spacing : {3.0, 1.5, 0.75})
    for (const double jitter : {0.0, 0.1, 0.2}) {
      const ShearError error = shear_error(spacing, jitter, held);
      EXPECT_LT(error.largest, 1e-5) << spacing << " " << jitter;
      EXPECT_GT(error.beside, 150);
    }
  EXPECT_GT(shear_error(dx, 0.1, slips).largest, 0.3) << "a bed that slips does not see it";
}

TEST(NoSlipImages, DoTheWorkThatTheStrainTakes) {
  auto constants = test::usual_constants(dx);
  constants.viscosity = 0;
  const auto images = test::work_of_images(test::rough_block_on_ground(dx), constants, held);
  EXPECT_LT(std::abs(images.work + images.power), 1e-6 * images.size);
  EXPECT_GT(std::abs(images.work), 1e-3 * images.size);
}

TEST(NoSlipImages, ArtificialViscosityTakesEnergyWhateverTheMotion) {
  const auto constants = test::usual_constants(dx);
  auto cloud = test::rough_block_on_ground(dx);
  for (SlowParticle& p : cloud) p.stress.setZero();
  for (const double share : {0.0, 0.4, 1.0}) {
    for (SlowParticle& p : cloud) p.held_viscosity = share * p.viscosity_share;
    const auto fast = test::fast_sweep(cloud, constants, fastest(), {}, held).rates;
    double work = 0, size = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double done = mass_of(cloud[i], constants) * fast[i].from_ground.dot(cloud[i].velocity);
      work += done, size += std::abs(done);
    }
    EXPECT_LT(work, -0.3 * size) << share;
  }
}

/// Layers in simple shear of stress `shear`, under a pressure; periodic along the bed.
std::vector<SlowParticle> sheared_layers(int layers, double shear, double pressure) {
  auto cloud = test::lattice({6, 6, layers}, dx, 0, {0, 0, 0.5 * layers * dx});
  for (SlowParticle& p : cloud) {
    p.ground_distance = p.position.z();
    p.stress = -pressure * Matrix3d::Identity();
    p.stress(0, 2) = p.stress(2, 0) = shear;
  }
  return cloud;
}

Domain endless() {
  Domain domain;
  domain.x = {true, -3 * dx, 3 * dx, 0};
  domain.y = {true, -3 * dx, 3 * dx, 0};
  return domain;
}

/// Forces per area along x, y and z that the bed gives.
Vec3 given_by_bed(const std::vector<SlowParticle>& cloud, bool bed) {
  const auto constants = test::usual_constants(dx);
  const auto rates = test::fast_sweep(cloud, constants, fastest(), endless(), bed).rates;
  Vec3 force(0, 0, 0);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    force += mass_of(cloud[i], constants) * rates[i].from_ground;
  return force / (36 * dx * dx);
}

TEST(NoSlipImages, TheBedBearsTheShearStressAndThePressureBesideIt) {
  const auto cloud = sheared_layers(8, 700, 5000);
  const Vec3 no_slip = given_by_bed(cloud, held), slip = given_by_bed(cloud, slips);
  EXPECT_NEAR(no_slip.x(), -700, 7);
  EXPECT_NEAR(no_slip.z(), 5000, 50);
  EXPECT_NEAR(no_slip.y(), 0, 1e-3);
  EXPECT_NEAR(slip.x(), 0, 1e-3);
  EXPECT_NEAR(slip.z(), no_slip.z(), 1e-3);
}

TEST(NoSlipImages, OnlyHeldViscosityDragsAtTheBed) {
  auto cloud = sheared_layers(8, 0, 0);
  for (SlowParticle& p : cloud) p.velocity = {2, 0, 0};
  const auto drag = [&](double share) {
    for (SlowParticle& p : cloud) p.held_viscosity = share;
    return -given_by_bed(cloud, held).x();
  };
  const double by_pairs = drag(1);
  EXPECT_GT(by_pairs, 1);
  EXPECT_NEAR(drag(0.25), 0.25 * by_pairs, 1e-4 * by_pairs);
  EXPECT_NEAR(drag(0), 0, 1e-6 * by_pairs);
}

/// Force per width across a vertical plane through a layer under hydrostatic pressure, over
/// rho g h^2/2: on a bed that holds it, too, the first layers feel the whole of the pressure.
TEST(NoSlipImages, ALayerPushesAlongTheBedAsOnOneThatSlips) {
  const auto constants = test::usual_constants(dx);
  Domain domain;
  domain.y = {true, -3 * dx, 3 * dx, 0};
  auto cloud = test::lattice({12, 6, 4}, dx, 0, {0, 0, 2 * dx});
  for (SlowParticle& p : cloud) {
    p.stress = -(4 * dx - p.position.z()) * Matrix3d::Identity();
    p.ground_distance = p.position.z();
  }
  const auto thrust = [&](bool bed) {
    const auto rates = test::fast_sweep(cloud, constants, fastest(), domain, bed).rates;
    double force = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (cloud[i].position.x() > 0)
        force += mass_of(cloud[i], constants) * rates[i].acceleration.x();
    return force / (6 * dx) / (8 * dx * dx);
  };
  EXPECT_NEAR(thrust(held), thrust(slips), 1e-5);
  EXPECT_GT(thrust(held), 0.985);
}

/// A spreading layer, u = e x above its first half spacing and w = -e z: as much goes out as sinks.
TEST(NoSlipImages, SpreadOverTheBedIsNoCompression) {
  const auto constants = test::usual_constants(dx);
  auto cloud = test::lattice({9, 9, 6}, dx, 0, {0, 0, 3 * dx});
  for (SlowParticle& p : cloud) {
    p.ground_distance = p.position.z();
    p.velocity = {0.5 * p.position.x(), 0, -0.5 * p.position.z()};
  }
  const auto rates = test::fast_sweep(cloud, constants, fastest(), {}, held).rates;
  int seen = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3& at = cloud[i].position;
    if (std::max(std::abs(at.x()), std::abs(at.y())) > 1.1 * dx || at.z() > 2 * dx) continue;
    EXPECT_NEAR(rates[i].gradient.trace(), 0, 2e-5) << at.z();
    ++seen;
  }
  EXPECT_EQ(seen, 18);
}

}  // namespace
}  // namespace sturz
