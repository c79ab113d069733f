// SPDX-License-Identifier: Apache-2.0
// The sweep of grains that may disperse, against its slow twin and against the dense sweep.
#include "engine/effects/kinetic/update.hpp"
#include "tests/support/sweep/sweep_scene.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace sturz {
namespace {

using test::SlowParticle;
using test::SlowRates;

constexpr double dx = 1.5;

/// Half of a rough block is dispersed: dilated, agitated, with kinetic stresses.
std::vector<SlowParticle> half_dispersed() {
  auto cloud = test::lattice({12, 11, 9}, dx, 0.2);
  test::roughen(cloud, dx);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0, 1);
  for (SlowParticle& p : cloud) {
    const Vec3 n = Vec3(0.2, -0.1, 1).normalized();
    p.wall_moment = 0.2 * u(random) * n * n.transpose();
    p.wall_gradient = 0.7 * n * n.transpose();
    if (p.position.x() < 0) continue;
    p.dilation_ratio = 1 + 8 * u(random);
    p.weight = p.dilation_ratio * (0.8 + 0.5 * u(random));
    p.theta = 4 * u(random);
    p.conductivity = 10 + 100 * u(random);
    p.viscosity_share = u(random);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b <= a; ++b)
        p.kinetic_stress(a, b) = p.kinetic_stress(b, a) = -2e3 * u(random);
  }
  return cloud;
}

using Part = std::pair<const char*, Eigen::MatrixXd (*)(const SlowRates&)>;
const std::vector<Part> parts{
    {"acceleration", [](const SlowRates& r) -> Eigen::MatrixXd { return r.acceleration; }},
    {"gradient", [](const SlowRates& r) -> Eigen::MatrixXd { return r.gradient; }},
    {"diffusion", [](const SlowRates& r) -> Eigen::MatrixXd { return Vec3(r.diffusion, 0, 0); }},
    {"conducted", [](const SlowRates& r) -> Eigen::MatrixXd { return Vec3(r.conducted, 0, 0); }},
    {"pair_gradient", [](const SlowRates& r) -> Eigen::MatrixXd { return r.pair_gradient; }},
    {"support_completeness",
     [](const SlowRates& r) -> Eigen::MatrixXd { return Vec3(r.support_completeness, 0, 0); }},
    {"smoothing", [](const SlowRates& r) -> Eigen::MatrixXd { return r.smoothing; }}};

TEST(KineticSweep, EqualsTheSlowTwin) {
  const auto constants = test::usual_constants(dx);
  const auto cloud = half_dispersed();
  const auto slow = test::slow_sweep(cloud, {}, constants, true);
  const auto still = test::slow_sweep(cloud, {}, constants);
  for (auto isa : {InstructionSet::plain, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!supports(isa)) continue;
    const auto fast = test::kinetic_sweep(cloud, constants, isa).rates;
    std::vector<SlowRates> twin;  // groups far from dispersed grains take the dense sweep
    int dispersed = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const bool dense_group = fast[i].neighbors == static_cast<int>(SweepOutput::uncounted);
      twin.push_back(dense_group ? still[i] : slow[i]);
      if (dense_group) twin.back().pair_gradient.setZero();
      if (dense_group) continue;
      ++dispersed;
      ASSERT_EQ(fast[i].neighbors, slow[i].neighbors);
    }
    EXPECT_GT(dispersed, 400);
    EXPECT_LT(dispersed, 1188);
    for (const auto& [name, part] : parts)
      EXPECT_LT(test::relative_error(fast, twin, part), 1e-5) << name << " " << to_string(isa);
  }
}

TEST(KineticSweep, ArtificialStressEqualsTheSlowTwinInBothSweeps) {
  auto constants = test::usual_constants(dx);
  constants.tension = true;
  auto cloud = half_dispersed();
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud[i].tension = 1e4 * (i % 5);
  const auto acceleration = [](const SlowRates& r) -> Eigen::MatrixXd { return r.acceleration; };
  for (auto isa : {InstructionSet::plain, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!supports(isa)) continue;
    EXPECT_LT(test::relative_error(test::kinetic_sweep(cloud, constants, isa).rates,
                                   test::slow_sweep(cloud, {}, constants, true), acceleration),
              1e-5);
  }
  for (SlowParticle& p : cloud) p.kinetic_stress.setZero(), p.viscosity_share = 1;
  const auto dense = test::fast_sweep(cloud, constants, best_instruction_set()).rates;
  EXPECT_LT(test::relative_error(dense, test::slow_sweep(cloud, {}, constants), acceleration),
            1e-5);
  constants.tension = false;
  const auto without = test::slow_sweep(cloud, {}, constants);
  EXPECT_GT(test::relative_error(dense, without, acceleration), 0.01);
}

TEST(KineticSweep, KeepsMomentumGranularEnergyAndEnergy) {
  const auto constants = test::usual_constants(dx);
  const auto cloud = half_dispersed();
  const auto fast = test::kinetic_sweep(cloud, constants, best_instruction_set()).rates;
  Vec3 force(0, 0, 0);
  double scale = 0, conducted = 0, conducted_scale = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double mass =
        cloud[i].volume * constants.reference_density * (1 + cloud[i].density_change);
    force += mass * fast[i].acceleration;
    scale += mass * fast[i].acceleration.norm();
    conducted += cloud[i].volume * cloud[i].dilation_ratio * fast[i].conducted;
    conducted_scale += cloud[i].volume * cloud[i].dilation_ratio * std::abs(fast[i].conducted);
  }
  EXPECT_LT(force.norm(), 1e-6 * scale);
  // What the kinetic force does to the motion is -Sum V sigma_k : pair_gradient.
  double work = 0, power = 0, size = 0;
  auto still = cloud;
  for (SlowParticle& p : still) p.kinetic_stress.setZero();
  const auto without = test::kinetic_sweep(still, constants, best_instruction_set()).rates;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const SlowParticle& p = cloud[i];
    const double mass = p.volume * constants.reference_density * (1 + p.density_change);
    work += mass * (fast[i].acceleration - without[i].acceleration).dot(p.velocity);
    power +=
        p.volume * p.dilation_ratio * p.kinetic_stress.cwiseProduct(fast[i].pair_gradient).sum();
    size += p.volume * p.dilation_ratio * p.kinetic_stress.norm() * fast[i].pair_gradient.norm();
  }
  EXPECT_LT(std::abs(work + power), 1e-4 * size);
  EXPECT_LT(std::abs(conducted), 1e-6 * conducted_scale);
}

TEST(KineticSweep, GivesTheDenseBitsWhereAllIsDense) {
  const auto constants = test::usual_constants(dx);
  auto cloud = test::lattice({12, 11, 9}, dx, 0.2);
  test::roughen(cloud, dx);
  const auto dense = test::fast_sweep(cloud, constants, best_instruction_set()).raw;
  const auto kinetic = test::kinetic_sweep(cloud, constants, best_instruction_set()).raw;
  const std::size_t shared = 20 * cloud.size();  // the outputs that both write
  EXPECT_EQ(std::memcmp(dense.data(), kinetic.data(), shared * sizeof(float)), 0);
}

TEST(KineticSweep, GivesTheSameBitsOnBothVectorWidths) {
  if (!supports(InstructionSet::avx512)) GTEST_SKIP() << "no AVX-512 here";
  const auto constants = test::usual_constants(dx);
  const auto cloud = half_dispersed();
  const auto wide = test::kinetic_sweep(cloud, constants, InstructionSet::avx512).raw;
  const auto narrow = test::kinetic_sweep(cloud, constants, InstructionSet::avx2).raw;
  EXPECT_EQ(std::memcmp(wide.data(), narrow.data(), wide.size() * sizeof(float)), 0);
}

/// A cloud whose grains have dilated alike sees a linear velocity field exactly.
TEST(KineticSweep, LinearVelocityGivesTheExactGradientInAnExpandedCloud) {
  const auto constants = test::usual_constants(dx);
  Eigen::Matrix3d a;
  a << 0.3, -1.2, 0.7, 0.4, 0.9, -0.5, 1.1, 0.2, -0.8;
  for (const double stretch : {1.2, 1.4}) {
    auto cloud = test::lattice({12, 12, 12}, stretch * dx, 0.1);
    for (SlowParticle& p : cloud) {
      p.volume = dx * dx * dx;
      p.dilation_ratio = stretch * stretch * stretch;
      p.velocity = a * p.position;
    }
    const auto fast = test::kinetic_sweep(cloud, constants, best_instruction_set()).rates;
    int inside = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud[i].position.cwiseAbs().maxCoeff() > 4 * stretch * dx) continue;
      ++inside;
      EXPECT_LT((fast[i].gradient - a).norm(), 1e-5 * a.norm());
      EXPECT_NEAR(fast[i].support_completeness * cloud[i].dilation_ratio, 1, 0.2);
    }
    EXPECT_GT(inside, 100);
  }
}

/// A grain that finds its first neighbour: the support completeness of the step before does not
/// include it, and the density follows later still.
TEST(KineticSweep, APairThatMeetsInEmptySpaceIsNotFeltManyTimesOver) {
  const auto constants = test::usual_constants(dx);
  for (const double dilation_ratio : {5.0, 30.0, 100.0, 1000.0}) {
    auto pair = test::lattice({2, 1, 1}, dx, 0);
    for (SlowParticle& p : pair) {
      p.dilation_ratio = dilation_ratio;
      p.weight = pair_weight(dilation_ratio, 0);
    }
    pair[0].velocity = Vec3(0, 0, 0), pair[1].velocity = Vec3(-1, 0, 0);
    const auto fast = test::kinetic_sweep(pair, constants, best_instruction_set()).rates;
    EXPECT_LT(fast[0].pair_gradient.norm(), 11 / dx)
        << dilation_ratio;  // 1/dx is what there is; it was 330
    EXPECT_GT(fast[0].pair_gradient.norm(), 0) << dilation_ratio;
  }
  for (const double dilation_ratio : {5.0, 30.0})
    for (const double filled : {0.4, 1.0, 3.0}) {
      const double weight = pair_weight(dilation_ratio, filled / dilation_ratio);
      EXPECT_NEAR(weight * weight / dilation_ratio * (filled / dilation_ratio), 1,
                  1e-12);  // the sums are whole
    }
}

int looks = 0;
std::int64_t next_look() { return ++looks; }

TEST(KineticSweep, ClockIsReadOnlyWhereTheKindOfGroupChangesAndChangesNoBit) {
  const auto constants = test::usual_constants(dx);
  const auto mixed = half_dispersed();
  auto resting = test::lattice({12, 11, 9}, dx, 0.2), stirred = resting;
  for (SlowParticle& p : stirred) p.dilation_ratio = p.weight = 1.5;
  for (auto isa : {InstructionSet::plain, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!supports(isa)) continue;
    const auto timed = [&](const std::vector<SlowParticle>& cloud) {
      looks = 0;
      DispersedClock clock{&next_look};
      const auto run = test::kinetic_sweep(cloud, constants, isa, {}, &clock);
      EXPECT_EQ(run.raw, test::kinetic_sweep(cloud, constants, isa).raw) << to_string(isa);
      EXPECT_EQ(2 * clock.spent_ns, looks);  // every stay among dispersed groups is one tick long
      return clock.spent_ns;
    };
    EXPECT_EQ(timed(resting), 0);
    EXPECT_EQ(timed(stirred), 1);
    EXPECT_GT(timed(mixed), 1);
  }
}

}  // namespace
}  // namespace sturz
