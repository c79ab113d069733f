// SPDX-License-Identifier: Apache-2.0
// The fastest wave of grains and liquid, against the lattice itself.
#include "engine/laws/mixture_sound.hpp"

#include "engine/neighbors/smoothing_kernel.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace sturz {
namespace {

using Vec3 = Eigen::Vector3d;

/// What the sums over a cubic lattice of spacing 1 do to a plane wave.
struct Symbols {
  double gradient = 0;  ///< of the sweep and of slopes
  double smoothed = 0;  ///< of weights
};

Symbols symbols(double k, const Vec3& along) {
  const SmoothingKernel kernel{1.3};
  Symbols out;
  double all = 0;
  for (int a = -3; a <= 3; ++a)
    for (int b = -3; b <= 3; ++b)
      for (int c = -3; c <= 3; ++c) {
        const Vec3 r(a, b, c);
        const double t = std::max(0.0, 1 - r.norm() / kernel.support()), phase = k * along.dot(r);
        out.gradient +=
            kernel.discrete_gradient_factor() * t * t * t * along.dot(r) * std::sin(phase);
        out.smoothed += kernel.value(r.norm()) * std::cos(phase), all += kernel.value(r.norm());
      }
  out.smoothed /= all;
  return out;
}

/// Largest omega over the largest gradient that the sweep has, all waves of the lattice.
double fastest(const MixtureSound& m, double share) {
  double most = 0, steepest = 0;
  for (const Vec3& along : {Vec3(1, 0, 0), Vec3(Vec3(1, 1, 0).normalized()),
                            Vec3(Vec3(1, 1, 1).normalized()), Vec3(Vec3(2, 1, 0).normalized())})
    for (double k = 0.05; k < 3.2; k += 0.05) {
      const Symbols s = symbols(k, along);
      const double c2 = m.liquid * m.liquid, r = m.density_ratio, w = s.smoothed;
      // Unknowns P/rho_f and Q/(alpha_p rho_p); what drives their second derivatives.
      Eigen::Matrix2d waves;
      waves << c2 * (1 + share * (1 - w) + share * r * w) +
                   4.0 / 3.0 * m.shear_stiffness * c2 / (1 + share),
          c2 * share, m.grains * m.grains * r * w, m.grains * m.grains;
      const double eigen = waves.eigenvalues().real().maxCoeff();
      most = std::max(most, s.gradient * s.gradient * eigen);
      steepest = std::max(steepest, s.gradient * s.gradient);
    }
  return std::sqrt(most / steepest);
}

TEST(MixtureSound, IsThatOfTheLatticesWorstWave) {
  for (const double share : {0.0, 0.1, 0.5, 1.0, 1.5, 4.0, 9.0})
    for (const double ratio : {0.0, 0.35, 0.6, 0.96})
      for (const double grains : {0.0, 50.0, 100.0, 200.0}) {
        const MixtureSound m{100, grains, 0.25, ratio};
        const double exact = fastest(m, share);
        EXPECT_NEAR(m.fastest(share), exact, 0.01 * exact)
            << share << " " << ratio << " " << grains;
      }
}

TEST(MixtureSound, IsTheLiquidsWithoutGrainsAndNeverSlower) {
  const MixtureSound m{100, 20, 0.25, 0.4};
  EXPECT_NEAR(m.fastest(0), 100 * std::sqrt(4.0 / 3.0), 1e-9);
  EXPECT_GE((MixtureSound{100, 300, 0.25, 0.4}).fastest(0), 300);
  double last = 0;
  for (double share = 0.5; share < 9; share += 0.1) {
    EXPECT_GT(m.fastest(share), last);
    EXPECT_LT(m.fastest(share), 100 * std::sqrt(1 + share) + 20);
    last = m.fastest(share);
  }
}

}  // namespace
}  // namespace sturz
