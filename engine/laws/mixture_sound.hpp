// SPDX-License-Identifier: Apache-2.0
/// How fast sound is on the lattice of grains and liquid that share space (docs/physics.md B.7).
///
/// A plane wave of number k along a lattice, both phases at rest, X grains' volume per liquid's,
/// r = rho_f/rho_p. The pair sweep's gradient is G(k), the weights between the sets smooth by W(k),
/// their slopes' gradient is G(k), too. With pressure P of the liquid and Q of the grains' contacts
///   v_f' = -G P/rho_f,   v_p' = -W G P/rho_p - G Q/(alpha_p rho_p)     (buoyancy; without it no P)
///   P' = -rho_f c_0^2 G [(1 + X) v_f + X (v_p - W v_f)],   Q' = -alpha_p rho_p c_p^2 G v_p
/// so that omega^2/G^2 is an eigenvalue of
///   | c_0^2 (1 + X (1 - (1 - r) W) + 4/3 s/(1 + X))    .    |   whose off-diagonal product is
///   |                       .                         c_p^2 |   X r W c_0^2 c_p^2
/// with the liquid's elastic answer to shear s c_0^2, on its share of each face. Without buoyancy
/// r = 0. Long waves (W = 1) run at c_0 sqrt(1 + X r) past free grains; short ones are not seen by
/// what passes between the sets, and would run at c_0 sqrt(1 + X), but for them the sweep's
/// gradient, which vanishes on the shortest wave, is small. Drag holds phases back that part, and
/// makes no wave faster.
#pragma once

#include <algorithm>
#include <cmath>

namespace sturz {

struct MixtureSound {
  double liquid = 100;            ///< c_0 of the equation of state [m/s]
  double grains = 100;            ///< c_p of the grains' contacts [m/s]
  double shear_stiffness = 0.25;  ///< s: shear modulus of the liquid over its bulk modulus [-]
  double density_ratio = 0;       ///< r where grains take their share of the pressure, else 0 [-]

  /// Speed at which a wave would have the highest frequency that the lattice has, by the gradient
  /// of the wave that the sweep sees best: a step for one material at this speed of sound is as
  /// short for both. \param share  X >= 0 [-]
  double fastest(double share) const {
    // (G/G_max)^2 and W of the Wendland smoothing kernel at h = 1.3 dx, k dx = 1.1 .. 2.3: the
    // largest of waves along edges, faces and diagonals of a cubic lattice.
    constexpr struct {
      double gradient2, smoothed;
    } waves[] = {{0.874, 0.762}, {0.978, 0.683}, {1, 0.600},    {0.948, 0.517},
                 {0.836, 0.437}, {0.688, 0.361}, {0.530, 0.292}};
    const double c2 = liquid * liquid, g2 = grains * grains;
    double most = 0;
    for (const auto& w : waves) {
      const double own = c2 * (1 + share * (1 - (1 - density_ratio) * w.smoothed) +
                               4.0 / 3.0 * shear_stiffness / (1 + share));
      const double both = share * density_ratio * w.smoothed * c2 * g2;
      const double apart = 0.5 * (own - g2);
      const double faster = 0.5 * (own + g2) + std::sqrt(apart * apart + both);
      most = std::max(most, w.gradient2 * faster);
    }
    return std::sqrt(most);
  }
};

}  // namespace sturz
