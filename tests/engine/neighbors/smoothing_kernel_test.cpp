// SPDX-License-Identifier: Apache-2.0
#include "engine/neighbors/smoothing_kernel.hpp"

#include "engine/core/vec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sturz {
namespace {

/// Midpoint rule over [0, end].
template <class F>
double integral(double end, F f) {
  constexpr int n = 4000;
  double sum = 0;
  for (int k = 0; k < n; ++k) sum += f((k + 0.5) * end / n);
  return sum * end / n;
}

TEST(SmoothingKernel, IntegratesToOne) {
  for (double h : {0.0195, 1.3, 15.6}) {
    const SmoothingKernel w{h};
    const double volume =
        integral(2 * h, [&](double r) { return 4 * std::numbers::pi * r * r * w.value(r); });
    EXPECT_NEAR(volume, 1, 1e-6);
  }
}

TEST(SmoothingKernel, EndsAtItsSupport) {
  const SmoothingKernel w{1.3};
  EXPECT_EQ(w.support(), 2.6);
  EXPECT_EQ(w.value(2.6), 0);
  EXPECT_EQ(w.value(9), 0);
  EXPECT_NEAR(w.value(0), 21 / (16 * std::numbers::pi * 1.3 * 1.3 * 1.3), 1e-15);
}

TEST(SmoothingKernel, GradientFactorIsTheDerivative) {
  const double h = 0.7;
  const SmoothingKernel w{h};
  for (double r : {0.01, 0.3, 0.7, 1.2, 1.39}) {
    const double step = 1e-5;
    const double slope = (w.value(r + step) - w.value(r - step)) / (2 * step);
    const double t = 1 - r / (2 * h);
    EXPECT_NEAR(-w.gradient_factor() * t * t * t * r, slope, 1e-7 * w.gradient_factor());
  }
}

TEST(SmoothingKernel, PlaneIntegralEqualsQuadrature) {
  const double h = 1.3;
  const SmoothingKernel w{h};
  for (double d : {0.0, 0.2, 0.65, 1.3, 2.0, 2.5}) {
    const double whole = integral(2 * h, [&](double s) {
      return 2 * std::numbers::pi * s * w.value(std::sqrt(s * s + d * d));
    });
    EXPECT_NEAR(w.plane_integral(d), whole, 2e-6) << d;
  }
  EXPECT_EQ(w.plane_integral(2.6), 0);
  EXPECT_EQ(w.plane_integral(5), 0);
  EXPECT_EQ(w.plane_integral(-1), w.plane_integral(0));
}

TEST(SmoothingKernel, PlaneIntegralIsTheMissingNormalGradient) {
  // By Gauss: the gradient integral over the far side of a plane is the plane's integral of W.
  const double h = 1, d = 0.4;
  const SmoothingKernel w{h};
  const double missing = integral(2 * h - d, [&](double below) {
    const double z = d + below;  // of a slab under the plane, gradient along the normal
    return integral(std::sqrt(std::max(0.0, 4 * h * h - z * z)), [&](double s) {
      const double r = std::hypot(s, z), t = 1 - r / (2 * h);
      return t > 0 ? 2 * std::numbers::pi * s * w.gradient_factor() * t * t * t * z : 0;
    });
  });
  EXPECT_NEAR(missing, w.plane_integral(d), 1e-5);
}

TEST(SmoothingKernel, DiscreteFactorMakesTheMomentTheIdentityOnACubicLattice) {
  const double dx = 2.5, h = 1.3 * dx;
  const SmoothingKernel w{h};
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j)
      for (int k = -3; k <= 3; ++k) {
        const Vec3 r = dx * Vec3(i, j, k);
        const double t = std::max(0.0, 1 - r.norm() / (2 * h));
        moment += dx * dx * dx * w.discrete_gradient_factor() * t * t * t * r * r.transpose();
      }
  EXPECT_LT((moment - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_NEAR(w.gradient_factor() / w.discrete_gradient_factor(), 0.979, 0.001);
}

}  // namespace
}  // namespace sturz
