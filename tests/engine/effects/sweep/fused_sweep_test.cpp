// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/sweep/fused_sweep.hpp"

#include "engine/neighbors/smoothing_kernel.hpp"
#include "tests/support/sweep/sweep_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace sturz {
namespace {

using Eigen::Matrix3d;
using test::SlowParticle;
using test::SlowRates;

constexpr double dx = 1.5;
const Vec3 utm_corner(412345.678, 5123456.789, 1234.5);

using Part = std::pair<const char*, Eigen::MatrixXd (*)(const SlowRates&)>;
const std::vector<Part> parts{
    {"acceleration", [](const SlowRates& r) -> Eigen::MatrixXd { return r.acceleration; }},
    {"gradient", [](const SlowRates& r) -> Eigen::MatrixXd { return r.gradient; }},
    {"diffusion", [](const SlowRates& r) -> Eigen::MatrixXd { return Vec3(r.diffusion, 0, 0); }},
    {"mirror weight",
     [](const SlowRates& r) -> Eigen::MatrixXd { return Vec3(r.mirror_weight, 0, 0); }},
    {"smoothing", [](const SlowRates& r) -> Eigen::MatrixXd { return r.smoothing; }}};

/// A block with free surfaces all around and walls' terms on some of the particles.
std::vector<SlowParticle> rough_block(const Vec3& center = {0, 0, 0}) {
  auto cloud = test::lattice({12, 11, 9}, dx, 0.2, center);
  test::roughen(cloud, dx);
  for (std::size_t i = 0; i < cloud.size(); i += 3) {
    const Vec3 n = Vec3(0.1 * (i % 7), -0.2, 1).normalized();
    cloud[i].wall_moment = 0.3 * n * n.transpose();
    cloud[i].wall_gradient = 1.7 * n * n.transpose();
  }
  return cloud;
}

InstructionSet fastest() { return best_instruction_set(); }

TEST(FusedSweep, EqualsTheSlowTwin) {
  const auto constants = test::usual_constants(dx);
  const auto cloud = rough_block();
  const auto slow = test::slow_sweep(cloud, {}, constants);
  for (auto isa : {InstructionSet::plain, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!supports(isa)) continue;
    const auto fast = test::fast_sweep(cloud, constants, isa).rates;
    for (const auto& [name, part] : parts)
      EXPECT_LT(test::relative_error(fast, slow, part), 1e-5) << name << " " << to_string(isa);
  }
}

TEST(FusedSweep, IsAsExactFarFromTheOrigin) {
  const auto constants = test::usual_constants(dx);
  const auto near = rough_block();
  auto far = near;
  for (SlowParticle& p : far) p.position += utm_corner;
  const auto slow = test::slow_sweep(far, {}, constants);
  const auto fast = test::fast_sweep(far, constants, fastest()).rates;
  const auto here = test::fast_sweep(near, constants, fastest()).rates;
  for (const auto& [name, part] : parts) {
    EXPECT_LT(test::relative_error(fast, slow, part), 1e-5) << name;
    EXPECT_LT(test::relative_error(fast, here, part), 1e-5) << name;
  }
}

TEST(FusedSweep, IsAsExactWithAFarOutlier) {
  const auto constants = test::usual_constants(dx);
  auto cloud = rough_block();
  SlowParticle lost = cloud[0];
  lost.position = {900 * dx, -400 * dx, -300 * dx};
  cloud.push_back(lost);
  const auto slow = test::slow_sweep(cloud, {}, constants);
  const auto fast = test::fast_sweep(cloud, constants, fastest()).rates;
  for (const auto& [name, part] : parts)
    EXPECT_LT(test::relative_error(fast, slow, part), 1e-5) << name;
  EXPECT_EQ(fast.back().acceleration, Vec3(0, 0, 0));
  EXPECT_EQ(fast.back().gradient, Matrix3d::Zero());
}

TEST(FusedSweep, WideVectorsGiveTheSameBits) {
  if (!supports(InstructionSet::avx512)) GTEST_SKIP() << "this machine has no AVX-512";
  const auto constants = test::usual_constants(dx);
  auto without_smoothing = constants;
  without_smoothing.stress_smoothing = 0;
  for (const auto& c : {constants, without_smoothing})
    for (int n : {1, 5, 16, 17, 700}) {
      auto cloud = rough_block(utm_corner);
      cloud.resize(n);
      const auto narrow = test::fast_sweep(cloud, c, InstructionSet::avx2).raw;
      const auto wide = test::fast_sweep(cloud, c, InstructionSet::avx512).raw;
      ASSERT_EQ(narrow.size(), wide.size());
      EXPECT_EQ(std::memcmp(narrow.data(), wide.data(), narrow.size() * sizeof(float)), 0) << n;
    }
}

TEST(FusedSweep, PairForcesKeepMomentum) {
  const auto constants = test::usual_constants(dx);
  auto cloud = test::lattice({16, 16, 10}, dx, 0.2, utm_corner);
  test::roughen(cloud, dx);
  const auto fast = test::fast_sweep(cloud, constants, fastest()).rates;
  Vec3 sum(0, 0, 0);
  double scale = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double mass =
        constants.reference_density * (1 + cloud[i].density_change) * cloud[i].volume;
    sum += mass * fast[i].acceleration;
    scale += mass * fast[i].acceleration.norm();
  }
  EXPECT_LT(sum.norm() / scale, 1e-7);
}

/// How many faces of an n[0] x n[1] x n[2] lattice its particle number `i` lies on.
int faces(std::size_t i, std::array<std::size_t, 3> n) {
  const std::size_t at[3] = {i / (n[1] * n[2]), i / n[2] % n[1], i % n[2]};
  int count = 0;
  for (int k = 0; k < 3; ++k) count += at[k] == 0 || at[k] == n[k] - 1;
  return count;
}

/// Linear field v = A x on a block, volumes as in a lattice.
std::vector<SlowParticle> sheared_block(const Matrix3d& a, const Vec3& center) {
  auto cloud = test::lattice({10, 10, 10}, dx, 0.15, center);
  for (SlowParticle& p : cloud) p.velocity = a * (p.position - center);
  return cloud;
}

TEST(FusedSweep, LinearVelocityGivesTheExactGradientInsideAndAtFreeSurfaces) {
  Matrix3d a;
  a << 0.3, -1.2, 0.7, 0.4, 0.9, -0.5, 1.1, 0.2, -0.8;
  const auto constants = test::usual_constants(dx);
  for (const Vec3& center : {Vec3(0, 0, 0), utm_corner}) {
    const auto cloud = sheared_block(a, center);
    const auto slow = test::slow_sweep(cloud, {}, constants);
    const auto fast = test::fast_sweep(cloud, constants, fastest()).rates;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (faces(i, {10, 10, 10}) > 1) continue;  // edges: too few neighbours, B = I (B.3)
      ASSERT_TRUE(slow[i].corrected);
      EXPECT_LT((fast[i].gradient - a).norm(), 5e-6 * a.norm());
    }
  }
}

TEST(FusedSweep, RigidMotionGivesNoStrain) {
  const auto constants = test::usual_constants(dx);
  Matrix3d spin;
  spin << 0, -2, 0.5, 2, 0, -1, -0.5, 1, 0;
  auto cloud = sheared_block(spin, {0, 0, 0});
  for (SlowParticle& p : cloud) p.velocity += Vec3(30, -20, 5);
  const auto slow = test::slow_sweep(cloud, {}, constants);
  const auto fast = test::fast_sweep(cloud, constants, fastest()).rates;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!slow[i].corrected) continue;
    const Matrix3d& l = fast[i].gradient;
    EXPECT_LT((l + l.transpose()).norm(), 2e-4);  // of velocities up to 40 m/s in float
  }
}

/// Walls' terms of a plane at height z0 for a particle that moves with `velocity`.
void add_wall(SlowParticle& p, const Vec3& n, const Vec3& point, double h) {
  const SmoothingKernel w{h};
  const double d = (p.position - point).dot(n), plane = 2 * w.plane_integral(d);
  p.wall_moment += plane * d * n * n.transpose();
  p.wall_gradient += plane * p.velocity.dot(n) * n * n.transpose();
}

TEST(FusedSweep, LinearVelocityGivesTheExactGradientBesideAWall) {
  // A motion that the mirror image shares: no flow through the wall, no shear along it.
  const auto constants = test::usual_constants(dx);
  const Vec3 n = Vec3(-0.4, 0.1, 1).normalized();
  Eigen::Matrix3d frame;  // rows: two tangents and the normal
  frame.row(2) = n;
  frame.row(0) = Vec3(n.z(), 0, -n.x()).normalized();
  frame.row(1) = n.cross(Vec3(frame.row(0)));
  Matrix3d local;
  local << 0.3, -1.2, 0, 0.4, 0.9, 0, 0, 0, -0.8;
  const Matrix3d a = frame.transpose() * local * frame;
  auto cloud = test::lattice({9, 9, 6}, dx, 0.1);
  for (SlowParticle& p : cloud) {  // a block that stands on the inclined wall
    p.position = frame.transpose() * (p.position + Vec3(0, 0, 3 * dx));
    p.velocity = a * p.position;
    add_wall(p, n, {0, 0, 0}, constants.h);
  }
  const auto slow = test::slow_sweep(cloud, {}, constants);
  const auto fast = test::fast_sweep(cloud, constants, fastest()).rates;
  int beside = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!slow[i].corrected) continue;
    beside += cloud[i].position.dot(n) < 2 * constants.h;
    EXPECT_LT((fast[i].gradient - a).norm(), 5e-6 * a.norm()) << cloud[i].position.dot(n);
  }
  EXPECT_GT(beside, 200);
}

TEST(FusedSweep, WithoutGrainsAboveAWallIsNotMirrored) {
  const auto constants = test::usual_constants(dx);
  auto sheet = test::lattice({9, 9, 1}, dx, 0);
  auto layers = test::lattice({9, 9, 4}, dx, 0);
  for (auto* cloud : {&sheet, &layers})
    for (SlowParticle& p : *cloud) {
      p.velocity = {0, 0, -1};
      add_wall(p, {0, 0, 1}, {0, 0, (*cloud)[0].position.z() - 0.5 * dx}, constants.h);
    }
  const auto alone = test::fast_sweep(sheet, constants, fastest()).rates[40];
  EXPECT_NEAR(alone.mirror_weight, 0, 1e-6);
  EXPECT_NEAR(alone.gradient(2, 2), 0, 1e-6);
  const auto carried = test::fast_sweep(layers, constants, fastest()).rates[std::size_t{40} * 4];
  EXPECT_EQ(carried.mirror_weight, 1);
  EXPECT_LT(carried.gradient(2, 2), -0.1);
}

TEST(FusedSweep, LinearDensityDoesNotDiffuse) {
  const auto constants = test::usual_constants(dx);
  auto cloud = test::lattice({10, 10, 8}, dx, 0.15, utm_corner);
  const Vec3 rise(1e-4, 0, -9e-4);  // per metre: a hydrostatic column on a slope
  auto rough = cloud;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(-6e-3, 6e-3);
  for (SlowParticle& p : cloud) {
    p.density_change = 6e-3 + rise.dot(p.position - utm_corner);
    p.density_gradient = rise;
  }
  for (SlowParticle& p : rough) p.density_change = u(random);
  const auto slow = test::slow_sweep(cloud, {}, constants);
  const auto column = test::fast_sweep(cloud, constants, fastest()).rates;
  const auto noise = test::fast_sweep(rough, constants, fastest()).rates;
  double scale = 0;
  for (const SlowRates& r : noise) scale += std::abs(r.diffusion) / noise.size();
  ASSERT_GT(scale, 0);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (faces(i, {10, 10, 8}) > 1) continue;
    ASSERT_TRUE(slow[i].corrected);
    EXPECT_LT((column[i].density_gradient - rise).norm(), 1e-5 * rise.norm());
    EXPECT_LT(std::abs(column[i].diffusion), 1e-5 * scale);
  }
}

TEST(FusedSweep, DiffusionDrawsDensitiesTogether) {
  const auto constants = test::usual_constants(dx);
  auto cloud = test::lattice({7, 7, 7}, dx, 0);
  const std::size_t middle = 3 * 49 + 3 * 7 + 3;
  cloud[middle].density_change = 0.01;
  const auto rates = test::fast_sweep(cloud, constants, fastest()).rates;
  EXPECT_LT(rates[middle].diffusion, 0);
  EXPECT_GT(rates[middle + 1].diffusion, 0);
}

TEST(FusedSweep, UniformStressRatioIsNotSmoothed) {
  auto constants = test::usual_constants(dx);
  constants.ratio_floor = 1e-3;
  auto cloud = test::lattice({8, 8, 8}, dx, 0.2);
  Matrix3d ratio;  // K0 state: s/p the same everywhere, p growing with depth
  ratio << -0.7, 0.1, 0, 0.1, -0.7, 0.05, 0, 0.05, -1.6;
  for (SlowParticle& p : cloud) {
    const double pressure = 2e4 * (10 - p.position.z());
    p.stress = pressure * ratio;
  }
  auto rough = cloud;
  test::roughen(rough, dx);
  const auto even = test::fast_sweep(cloud, constants, fastest()).rates;
  const auto noise = test::fast_sweep(rough, constants, fastest()).rates;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    EXPECT_LT(even[i].smoothing.norm(), 1e-5 * noise[i].smoothing.norm() + 1e-4);
}

TEST(FusedSweep, ViscosityResistsApproachAndSeparation) {
  auto constants = test::usual_constants(dx);
  auto pair = test::lattice({2, 1, 1}, dx, 0);
  for (double sign : {-1.0, 1.0}) {
    pair[0].velocity = {-sign, 0, 0};
    pair[1].velocity = {sign, 0, 0};
    const auto rates = test::fast_sweep(pair, constants, fastest()).rates;
    EXPECT_GT(rates[0].acceleration.x() * sign, 0);
    EXPECT_LT(rates[1].acceleration.x() * sign, 0);
  }
  // Sliding past each other costs nothing: the viscosity acts along the line of centres.
  pair[0].velocity = {0, 1, 0};
  pair[1].velocity = {0, -1, 0};
  EXPECT_EQ(test::fast_sweep(pair, constants, fastest()).rates[0].acceleration, Vec3(0, 0, 0));
}

TEST(FusedSweep, ParticlesInOnePlaceDoNotBlowUp) {
  const auto constants = test::usual_constants(dx);
  auto cloud = rough_block();
  for (int k = 1; k < 5; ++k) cloud[k].position = cloud[0].position;
  for (const SlowRates& r : test::fast_sweep(cloud, constants, fastest()).rates) {
    ASSERT_TRUE(r.acceleration.allFinite());
    ASSERT_TRUE(r.gradient.allFinite());
    ASSERT_TRUE(std::isfinite(r.diffusion));
    ASSERT_TRUE(r.smoothing.allFinite());
  }
}

TEST(FusedSweep, PeriodicImagesActAsNeighbours) {
  const auto constants = test::usual_constants(dx);
  Domain domain;
  domain.y = {true, 10, 10 + 8 * dx, 2.5};
  auto cloud = test::lattice({6, 8, 5}, dx, 0.2, {0, 10 + 4 * dx, 0});
  for (SlowParticle& p : cloud) domain.wrap(p.position.x(), p.position.y(), p.position.z());
  test::roughen(cloud, dx);
  for (SlowParticle& p : cloud) p.wall_moment(2, 2) = 0.2;
  std::vector<SlowParticle> images;
  for (const SlowParticle& p : cloud)
    for (double turn : {-1.0, 1.0}) {
      images.push_back(p);
      images.back().position += turn * Vec3(0, domain.y.length(), domain.y.rise);
    }
  const auto slow = test::slow_sweep(cloud, images, constants);
  const auto fast = test::fast_sweep(cloud, constants, fastest(), domain).rates;
  for (const auto& [name, part] : parts)
    EXPECT_LT(test::relative_error(fast, slow, part), 1e-5) << name;
}

}  // namespace
}  // namespace sturz
