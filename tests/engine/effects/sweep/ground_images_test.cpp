// SPDX-License-Identifier: Apache-2.0
// Neighbours mirrored in the ground (docs/physics.md B.10, ADR 0037).
#include "tests/engine/effects/sweep/ground_block.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace sturz {
namespace {

using Eigen::Matrix3d;
using test::mass_of;
using test::SlowParticle;
using test::tilted_frame;

constexpr double dx = 1.5;

InstructionSet fastest() { return best_instruction_set(); }

std::vector<SlowParticle> block_on_ground(std::array<int, 3> n, double jitter) {
  return test::block_on_ground(n, dx, jitter);
}
std::vector<SlowParticle> rough_block() { return test::rough_block_on_ground(dx); }

TEST(GroundImages, EqualTheSlowTwin) {
  const auto constants = test::usual_constants(dx);
  const auto cloud = rough_block();
  const auto slow = test::slow_sweep(cloud, {}, constants);
  for (auto isa : {InstructionSet::plain, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!supports(isa)) continue;
    const auto fast = test::fast_sweep(cloud, constants, isa).rates;
    for (const auto& [name, part] : test::parts_with_images())
      EXPECT_LT(test::relative_error(fast, slow, part), 1e-5) << name << " " << to_string(isa);
  }
}

TEST(GroundImages, EqualTheSlowTwinAmongDispersedGrains) {
  const auto constants = test::usual_constants(dx);
  auto cloud = rough_block();
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(0, 1);
  for (SlowParticle& p : cloud) {
    p.dilation_ratio = 1.2 + 3 * u(random);
    p.weight = p.dilation_ratio;
  }
  const auto slow = test::slow_sweep(cloud, {}, constants, true);
  const auto fast = test::kinetic_sweep(cloud, constants, fastest()).rates;
  for (const auto& [name, part] : test::parts_with_images())
    EXPECT_LT(test::relative_error(fast, slow, part), 1e-5) << name;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    EXPECT_NEAR(fast[i].support_completeness, slow[i].support_completeness, 1e-5);
}

TEST(GroundImages, AreThoseOfPeriodicNeighboursToo) {
  const auto constants = test::usual_constants(dx);
  Domain domain;
  domain.y = {true, -4 * dx, 4 * dx, 0};
  auto cloud = test::lattice({6, 8, 4}, dx, 0.2, {0, 0, 2 * dx});
  for (SlowParticle& p : cloud) domain.wrap(p.position.x(), p.position.y(), p.position.z());
  test::roughen(cloud, dx);
  std::vector<SlowParticle> images;
  for (SlowParticle& p : cloud) {
    p.ground_distance = p.position.z();
    for (double turn : {-1.0, 1.0}) {
      images.push_back(p);
      images.back().position.y() += turn * domain.y.length();
    }
  }
  const auto slow = test::slow_sweep(cloud, images, constants);
  const auto fast = test::fast_sweep(cloud, constants, fastest(), domain).rates;
  for (const auto& [name, part] : test::parts_with_images())
    EXPECT_LT(test::relative_error(fast, slow, part), 1e-5) << name;
}

TEST(GroundImages, WideVectorsGiveTheSameBits) {
  if (!supports(InstructionSet::avx512)) GTEST_SKIP() << "this machine has no AVX-512";
  const auto constants = test::usual_constants(dx);
  for (int n : {1, 5, 16, 17, 700}) {
    auto cloud = rough_block();
    cloud.resize(n);
    const auto narrow = test::fast_sweep(cloud, constants, InstructionSet::avx2).raw;
    const auto wide = test::fast_sweep(cloud, constants, InstructionSet::avx512).raw;
    ASSERT_EQ(narrow.size(), wide.size());
    EXPECT_EQ(std::memcmp(narrow.data(), wide.data(), narrow.size() * sizeof(float)), 0) << n;
  }
}

/// Force per width across a vertical plane through a layer under hydrostatic pressure, over
/// rho g h^2/2: that on all grains on one side, whose forces on each other cancel.
double thrust(int layers, bool mirrored) {
  const auto constants = test::usual_constants(dx);
  Domain domain;
  domain.y = {true, -3 * dx, 3 * dx, 0};
  auto cloud = test::lattice({12, 6, layers}, dx, 0, {0, 0, 0.5 * layers * dx});
  for (SlowParticle& p : cloud) {
    p.stress = -(layers * dx - p.position.z()) * Matrix3d::Identity();
    if (mirrored) p.ground_distance = p.position.z();
  }
  const auto rates = test::fast_sweep(cloud, constants, fastest(), domain).rates;
  double force = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud[i].position.x() > 0)
      force += mass_of(cloud[i], constants) * rates[i].acceleration.x();
  return force / (6 * dx) / (0.5 * layers * dx * layers * dx);
}

TEST(GroundImages, ALayerPushesAlongTheGroundWithItsWholeThrust) {
  const double three = thrust(3, true), four = thrust(4, true), eight = thrust(8, true);
  EXPECT_NEAR(thrust(3, false), 0.856, 0.002);  // what is lost without them
  EXPECT_GE(three, 0.97);
  EXPECT_GE(four, 0.985);
  EXPECT_LE(eight, 1);
  EXPECT_GE(std::log((1 - three) / (1 - eight)) / std::log(8.0 / 3), 1.8);
  RecordProperty("thrust_3_4_8",
                 std::to_string(three) + " " + std::to_string(four) + " " + std::to_string(eight));
}

TEST(GroundImages, DoTheWorkThatTheStrainTakes) {
  auto constants = test::usual_constants(dx);
  constants.viscosity = 0;
  const auto images = test::work_of_images(rough_block(), constants, false);
  EXPECT_LT(std::abs(images.work + images.power), 1e-6 * images.size);
  EXPECT_GT(std::abs(images.work), 1e-3 * images.size);
}

TEST(GroundImages, PushAwayFromThePlaneAndNotAlongIt) {
  const auto constants = test::usual_constants(dx);
  const auto cloud = rough_block();
  const auto fast = test::fast_sweep(cloud, constants, fastest()).rates;
  Vec3 force(0, 0, 0);
  double scale = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    force += mass_of(cloud[i], constants) * fast[i].from_ground;
    scale += mass_of(cloud[i], constants) * fast[i].from_ground.norm();
  }
  const Vec3 local = tilted_frame() * force;
  EXPECT_LT(std::hypot(local.x(), local.y()), 1e-6 * scale);
  EXPECT_GT(local.z(), 0.1 * scale);
}

TEST(GroundImages, LinearVelocityAlongTheGroundGivesTheExactGradient) {
  const auto constants = test::usual_constants(dx);
  const Matrix3d frame = tilted_frame();
  Matrix3d local;  // no flow through the ground, no shear along it
  local << 0.3, -1.2, 0, 0.4, 0.9, 0, 0, 0, -0.8;
  const Matrix3d a = frame.transpose() * local * frame;
  auto cloud = block_on_ground({9, 9, 6}, 0.1);
  for (SlowParticle& p : cloud) p.velocity = a * p.position;
  const auto slow = test::slow_sweep(cloud, {}, constants);
  const auto fast = test::fast_sweep(cloud, constants, fastest()).rates;
  int beside = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!slow[i].corrected) continue;
    beside += cloud[i].ground_distance < 2 * constants.h;
    EXPECT_LT((fast[i].gradient - a).norm(), 5e-6 * a.norm()) << cloud[i].ground_distance;
  }
  EXPECT_GT(beside, 200);
}

TEST(GroundImages, HaveNoWeightWithoutGrainsAbove) {
  const auto constants = test::usual_constants(dx);
  for (const int layers : {1, 4}) {
    auto sheet = block_on_ground({9, 9, layers}, 0);
    const auto lowest =
        test::fast_sweep(sheet, constants, fastest()).rates[40 * std::size_t(layers)];
    EXPECT_NEAR(lowest.ground_weight, layers > 1, 1e-6);
    for (SlowParticle& p : sheet) {
      p.ground_weight = lowest.ground_weight;
      p.velocity = -p.ground_normal;
      p.stress = -Matrix3d::Identity();
    }
    const auto next = test::fast_sweep(sheet, constants, fastest()).rates[40 * std::size_t(layers)];
    const double pushed = next.from_ground.dot(sheet[0].ground_normal);
    const double strain = next.gradient.trace();
    if (layers > 1) {
      EXPECT_GT(pushed, 1e-4);
      EXPECT_LT(strain, -0.1);
    } else {
      EXPECT_NEAR(pushed, 0, 1e-9);
      EXPECT_NEAR(strain, 0, 1e-6);
    }
  }
}

TEST(FusedSweep, DiffusionGivesAndTakesTheSame) {
  const auto constants = test::usual_constants(dx);
  const auto cloud = rough_block();
  const auto fast = test::fast_sweep(cloud, constants, fastest()).rates;
  double sum = 0, scale = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    sum += cloud[i].volume * fast[i].diffusion;
    scale += cloud[i].volume * std::abs(fast[i].diffusion);
  }
  EXPECT_GT(scale, 0);
  EXPECT_LT(std::abs(sum), 1e-6 * scale);
}

}  // namespace
}  // namespace sturz
