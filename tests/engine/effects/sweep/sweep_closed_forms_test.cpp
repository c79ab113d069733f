// SPDX-License-Identifier: Apache-2.0
// The dense sweep on lattices, where its sums have closed forms. Its slow twin (fused_sweep_test)
// has the same formulas and proves arithmetic; here the references are the balance laws.
#include "tests/support/sweep/sweep_scene.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace sturz {
namespace {

using Eigen::Matrix3d;
using test::SlowParticle;
using test::SlowRates;

constexpr double dx = 1.5;
constexpr std::array<int, 3> block{11, 11, 11};

/// Without viscosity, diffusion and smoothing: stress alone.
SweepConstants stress_alone() {
  SweepConstants c = test::usual_constants(dx);
  c.viscosity = c.density_diffusion = c.stress_smoothing = 0;
  return c;
}

/// Calls `check` for every particle whose support lies within the block. \return how many
template <class Check>
int inside(const std::vector<SlowParticle>& cloud, const std::vector<SlowRates>& rates,
           Check check) {
  const double reach = 0.5 * (block[0] - 1) * dx - 2.6 * dx;
  int n = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud[i].position.cwiseAbs().maxCoeff() <= reach) check(cloud[i], rates[i]), ++n;
  return n;
}

/// Grains at rest under their weight: dp/dz = -rho g everywhere, so the sweep gives g upwards. A
/// factor wrong in the stress divergence shows here, and nowhere in the ledger's residual (S4).
TEST(SweepClosedForm, HydrostaticPressureCarriesTheWeight) {
  const SweepConstants c = stress_alone();
  auto cloud = test::lattice(block, dx, 0);
  const double g = 9.81;
  for (SlowParticle& p : cloud)
    p.stress = -c.reference_density * g * (10 * dx - p.position.z()) * Matrix3d::Identity();
  const auto rates = test::fast_sweep(cloud, c, best_instruction_set()).rates;
  EXPECT_EQ(inside(cloud, rates,
                   [&](const SlowParticle&, const SlowRates& r) {
                     EXPECT_LT((r.acceleration - Vec3(0, 0, g)).norm(), 1e-4 * g);
                   }),
            5 * 5 * 5);
}

/// rho a_k = d(sigma_kl)/dx_l of any stress that is linear in the place: shear stresses too.
TEST(SweepClosedForm, LinearStressGivesItsDivergence) {
  const SweepConstants c = stress_alone();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto symmetric = [&](double size) {
    Matrix3d m;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b <= a; ++b) m(a, b) = m(b, a) = size * u(random);
    return m;
  };
  const Matrix3d mean = symmetric(3e4);
  const std::array<Matrix3d, 3> slope{symmetric(1e4), symmetric(1e4), symmetric(1e4)};
  auto cloud = test::lattice(block, dx, 0);
  for (SlowParticle& p : cloud) {
    p.stress = mean;
    for (int l = 0; l < 3; ++l) p.stress += p.position[l] * slope[l];
  }
  Vec3 expected(0, 0, 0);
  for (int l = 0; l < 3; ++l) expected += slope[l].col(l) / c.reference_density;
  const auto rates = test::fast_sweep(cloud, c, best_instruction_set()).rates;
  inside(cloud, rates, [&](const SlowParticle&, const SlowRates& r) {
    EXPECT_LT((r.acceleration - expected).norm(), 1e-4 * expected.norm());
  });
}

/// Moments of a lattice are the kernel's by the discrete factor: without any correction a linear
/// field has its gradient.
TEST(SweepClosedForm, EvenStressAndLinearFieldsLeaveALatticeAtRest) {
  SweepConstants c = test::usual_constants(dx);
  auto cloud = test::lattice(block, dx, 0);
  Matrix3d a;
  a << 0.3, -1.2, 0.7, 0.4, 0.9, -0.5, 1.1, 0.2, -0.8;
  for (SlowParticle& p : cloud) {
    p.stress = -2e4 * Matrix3d::Identity();
    p.velocity = a * p.position;
    p.density_change = 0;
  }
  const auto rates = test::fast_sweep(cloud, c, best_instruction_set()).rates;
  // One pair's force, for the scale: 2 p V/rho dW/dr is some p/(rho dx).
  const double scale = 2e4 / (c.reference_density * dx);
  inside(cloud, rates, [&](const SlowParticle&, const SlowRates& r) {
    EXPECT_LT((r.gradient - a).norm(), 1e-5 * a.norm());
    EXPECT_LT(r.acceleration.norm(), 1e-3 * scale) << "viscosity of a linear velocity is zero";
    EXPECT_LT(std::abs(r.diffusion), 1e-9);
  });
}

/// Bilateral viscosity is that of a fluid: nu (lap v + 2 grad div v) with nu = alpha h c / 10 in
/// three dimensions (Monaghan 2005). A cubic lattice is not isotropic: its fourth moments make
/// shear along its axes 12 % weaker and squeezing 6 % stronger. Their mean over all directions,
/// 6/15 and 9/15 of the two, is a sum over radii alone and has to be nu.
TEST(SweepClosedForm, ViscosityIsThatOfAFluid) {
  SweepConstants c = stress_alone();
  c.viscosity = 0.1;
  const double nu = c.viscosity * c.h * c.sound_speed / 10;
  auto shear = test::lattice(block, dx, 0), squeeze = shear;
  const double bend = 0.02;  // second derivative of the velocity [1/(m s)]
  for (SlowParticle& p : shear) p.velocity.x() = 0.5 * bend * p.position.z() * p.position.z();
  for (SlowParticle& p : squeeze) p.velocity.z() = 0.5 * bend * p.position.z() * p.position.z();
  const auto sheared = test::fast_sweep(shear, c, best_instruction_set()).rates;
  const auto squeezed = test::fast_sweep(squeeze, c, best_instruction_set()).rates;
  const std::size_t middle = shear.size() / 2;
  const double along = sheared[middle].acceleration.x() / (nu * bend);
  const double across = squeezed[middle].acceleration.z() / (3 * nu * bend);
  EXPECT_NEAR((6 * along + 9 * across) / 15, 1, 0.03);
  inside(shear, sheared, [&](const SlowParticle&, const SlowRates& r) {
    EXPECT_NEAR(r.acceleration.x() / (nu * bend), along, 1e-3);
  });
}

/// dW/dr of Wendland C2 (B.1), normalised like the sweep's.
double slope_of_kernel(double r, const SweepConstants& c) {
  const double q = r / c.h, rest = 1 - 0.5 * q;
  if (q >= 2) return 0;
  const double h4 = c.h * c.h * c.h * c.h;
  const double analytic = -105 / (16 * std::numbers::pi * h4) * q * rest * rest * rest;
  return analytic * c.gradient_factor * 16 * std::numbers::pi * h4 * c.h / 105;
}

/// Sums of a particle that no correction has touched.
struct Plain {
  Matrix3d gradient = Matrix3d::Zero();  ///< Sum V_j (v_j - v_i) grad W
  Matrix3d moment = Matrix3d::Zero();    ///< Sum V_j (x_j - x_i) grad W
};
std::vector<Plain> plain_sums(const std::vector<SlowParticle>& cloud, const SweepConstants& c) {
  std::vector<Plain> sums(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    for (std::size_t j = 0; j < cloud.size(); ++j) {
      const Vec3 r = cloud[i].position - cloud[j].position;
      const double distance = r.norm();
      if (i == j || distance >= 2 * c.h) continue;
      const Vec3 grad = slope_of_kernel(distance, c) * r / distance;
      sums[i].gradient +=
          cloud[j].volume * (cloud[j].velocity - cloud[i].velocity) * grad.transpose();
      sums[i].moment -= cloud[j].volume * r * grad.transpose();
    }
  return sums;
}

class WorkIsPower : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(Jitters, WorkIsPower, testing::Values(0.0, 0.1, 0.25), [](const auto& i) {
  return "Percent" + std::to_string(std::lround(100 * i.param));
});

/// What the pair forces do to the motion is minus the power of the stress on the gradient that is
/// their adjoint, Sum V sigma : Sum V_j (v_j - v_i) grad W: to rounding, whatever velocities,
/// stresses and places. And the gradient that the stress law sees is that one, corrected by the
/// moment: force and strain rate are one discretisation (S4).
TEST_P(WorkIsPower, OfTheUncorrectedGradient) {
  const SweepConstants c = stress_alone();
  for (const std::array<int, 3> n : {block, std::array<int, 3>{14, 9, 3}, {20, 6, 1}}) {
    auto cloud = test::lattice(n, dx, GetParam(), {0, 0, 0}, 3);
    test::roughen(cloud, dx);
    const auto plain = plain_sums(cloud, c);
    for (auto isa : {InstructionSet::plain, InstructionSet::avx2, InstructionSet::avx512}) {
      if (!supports(isa)) continue;
      const auto rates = test::fast_sweep(cloud, c, isa).rates;
      double work = 0, power = 0, size = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const SlowParticle& p = cloud[i];
        const double mass = p.volume * c.reference_density * (1 + p.density_change);
        work += mass * rates[i].acceleration.dot(p.velocity);
        power += p.volume * p.stress.cwiseProduct(plain[i].gradient).sum();
        size += p.volume * p.stress.norm() * plain[i].gradient.norm();
        // Where the moment is too poor the sweep leaves the gradient as it is (B.3).
        const Matrix3d seen = rates[i].gradient * plain[i].moment;
        const double off = std::min((seen - plain[i].gradient).norm(),
                                    (rates[i].gradient - plain[i].gradient).norm());
        EXPECT_LT(off, 2e-5 * (1 + plain[i].gradient.norm()));
      }
      EXPECT_LT(std::abs(work + power), 1e-6 * size) << to_string(isa);
      EXPECT_GT(std::abs(power), 1e-4 * size) << "says nothing";
    }
  }
}

}  // namespace
}  // namespace sturz
