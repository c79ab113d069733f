// SPDX-License-Identifier: Apache-2.0
/// Lateral over vertical stress in a depth-averaged granular flow.
#pragma once

#include <algorithm>
#include <cmath>

namespace sturz {

/// Least and greatest K of a Coulomb material over a rough bed (Savage & Hutter 1989):
///   K = 2 (1 -+ sqrt(1 - cos^2 phi (1 + tan^2 delta))) / cos^2 phi - 1
struct EarthPressure {
  double active = 1, passive = 1;

  EarthPressure() = default;
  /// \param internal_friction tan phi; \param basal_friction tan delta, at most tan phi counts
  EarthPressure(double internal_friction, double basal_friction) {
    const double cos2 = 1 / (1 + internal_friction * internal_friction);
    const double root = std::sqrt(std::max(0.0, 1 - cos2 * (1 + basal_friction * basal_friction)));
    active = 2 * (1 - root) / cos2 - 1;
    passive = 2 * (1 + root) / cos2 - 1;
  }
  /// Pore pressure acts alike in all directions, so it draws K towards one.
  EarthPressure with_pore_pressure(double ratio) const {
    EarthPressure e;
    e.active = active * (1 - ratio) + ratio;
    e.passive = passive * (1 - ratio) + ratio;
    return e;
  }
  /// Differs from the isotropic 1 anywhere. Over a bed as rough as the mass, active and passive
  /// meet at 1 + 2 tan^2 phi.
  bool varies() const { return active != 1 || passive != 1; }

  /// K after a strain: falls where the mass stretches, rises where it is pushed together (Hungr
  /// 1995; McDougall & Hungr 2004). A mass that does not strain keeps its K, so nothing ratchets
  /// at rest.
  /// \param strain divergence of the velocity times dt [-]; \param stiffness dK per strain
  double strained(double k, double strain, double stiffness) const {
    return std::clamp(k - stiffness * strain, active, passive);
  }
};

}  // namespace sturz
