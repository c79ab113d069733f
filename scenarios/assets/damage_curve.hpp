// SPDX-License-Identifier: Apache-2.0
/// Vulnerability: which share of its value an asset loses at an intensity.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <string>
#include <vector>

namespace sturz {

/// A piecewise linear curve that never falls.
struct DamageCurve {
  struct Point {
    double intensity = 0;  ///< SI: m, m s-1, J m-2 or Pa
    double damage = 0;     ///< share of the value, 0..1
  };
  std::string name;                            ///< of the class
  PeakLayer intensity = PeakLayer::thickness;  ///< thickness, speed, energy or pressure
  std::vector<Point> points;                   ///< strictly rising intensity, damage not falling
};

/// Damage at an intensity in SI: linear between the points, 0 below the first one, that of the last
/// one beyond it. A curve that does not begin at damage 0 begins with a step.
/// \pre the curve has a point
double damage_at(const DamageCurve& curve, double intensity);

}  // namespace sturz
